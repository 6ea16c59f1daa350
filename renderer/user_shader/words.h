#pragma once

#include <string_view>

namespace volcast::user_shader {

/// What a word of GLSL text means before any declaration.
enum class Word {
    kType,      ///< float, vec3, ...
    kKeyword,   ///< if, for, const, ...
    kRefused,   ///< A word of GLSL that user code may not use; refusalOf() says why.
    kFunction,  ///< A function of GLSL that may be called.
    kOffered,   ///< A function, a type or a constant that the renderer offers.
    kOther,     ///< Left to be declared.
};

Word wordKind(std::string_view word);

/// Why a kRefused word is.
std::string_view refusalOf(std::string_view word);

/// Words that may follow a dot and are left as they are: swizzles and `length`.
bool isSelector(std::string_view word);

}  // namespace volcast::user_shader
