#pragma once

#include <string>

namespace volcast::user_shader {

/// Something wrong with a user's code, at a place of it.
struct Complaint {
    int line = 1;    ///< From 1.
    int column = 1;  ///< Bytes, from 1.
    std::string message;
    friend bool operator==(const Complaint&, const Complaint&) = default;
};

}  // namespace volcast::user_shader
