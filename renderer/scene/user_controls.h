#pragma once

#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "renderer/scene/scene.h"
#include "renderer/user_shader/check_text.h"
#include "renderer/user_shader/generate.h"

namespace volcast::scene {

/// Whether a user's code says what samples of `layer` show, instead of its map.
bool runsUserCode(const Layer& layer);

/// The code of `shader`, its controls with their states as initial values.
///
/// Errors: kInvalidArgument with the user's lines; kInvalidArgument, kNotFound for a state that no
/// control can have. `field` is beneath `path`.
Result<user_shader::Checked> resolved(const UserShader& shader, const std::string& path);

/// Errors: as resolved(); kUnsupported for a ray model or a light that code has no part in.
Result<void> validateShader(const Layer& layer, const std::string& path);
/// Against the data: kUnsupported, and kNotFound for a channel that is not there.
Result<void> validateShader(const Layer& layer, const data::DatasetSummary& summary,
                            const std::string& path);

/// How code sees the numbers of a dataset.
user_shader::ValueType valueType(const data::DatasetSummary& summary);

/// One error of all that is wrong with a code, a line each: "line 3, column 5: ...".
Error shaderError(const std::vector<user_shader::Complaint>& complaints, const std::string& path);

/// The channels, or fields of a mesh, that `code` reads besides that of `layer`, ascending.
std::vector<int> otherChannels(const user_shader::Checked& code, const Layer& layer,
                               const data::DatasetSummary& summary);

/// Whether the code of a valid `layer` reads any.
bool readsOtherChannels(const Layer& layer, const data::DatasetSummary& summary);

/// Most of them in one program; shaders/volume/user_channels.glsl and shaders/mesh/user_fields.glsl
/// have as many textures.
inline constexpr std::size_t kMaxOtherChannels = 7;
inline constexpr std::size_t kMaxOtherFields = 5;

}  // namespace volcast::scene
