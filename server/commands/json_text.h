#pragma once

#include <string>

#include <boost/json.hpp>

namespace volcast::commands {

/// JSON in one line with numbers as people write them (417.09, where Boost.JSON's own serializer
/// prints 4.1709E2). Numbers that JSON lacks become null.
std::string jsonText(const boost::json::value& value);

}  // namespace volcast::commands
