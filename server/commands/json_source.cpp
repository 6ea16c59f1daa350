// The one place where Boost.JSON's code is compiled for the commands.
#include <boost/json/src.hpp>
