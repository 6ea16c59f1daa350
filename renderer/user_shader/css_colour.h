#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

namespace volcast::user_shader {

/// Red, green and blue of an opaque CSS colour, sRGB-encoded, 0 to 1: "#rgb", "#rrggbb",
/// "rgb(255, 0, 0)" or a name such as "orange". Nothing for other text.
///
/// Source: W3C, CSS Color Module Level 4, sections 5 and 6.1.
std::optional<glm::vec3> cssColour(std::string_view text);

/// "#rrggbb" of the nearest colour of 8 bits a channel.
std::string hexColour(const glm::vec3& srgb);

/// Linear RGB of an sRGB-encoded colour.
glm::vec3 linearFromSrgb(const glm::vec3& srgb);

}  // namespace volcast::user_shader
