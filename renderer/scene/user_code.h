#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"
#include "renderer/scene/scene.h"
#include "renderer/shading/assemble.h"
#include "renderer/user_shader/complaint.h"
#include "renderer/user_shader/control.h"

namespace volcast::scene {

/// What a program and a draw need of a layer's code.
struct UserCode {
    std::vector<shading::TextChunk> texts;
    std::vector<int> otherChannels;  ///< By number, in the order of their textures.
    int iterations = 0;              ///< Of the code's own loops, for one sample.
    std::vector<glm::vec4> texels;   ///< The controls.
};

/// Makes UserCode of layers; what glslang says of a text is asked for once.
class UserCodes {
public:
    /// Errors: kInvalidArgument with the user's lines, `field` beneath `path`. `layer` must be
    /// valid.
    Result<UserCode> of(const Layer& layer, const data::DatasetSummary& summary,
                        const shading::ChunkSource& chunks, const std::string& path);

private:
    struct Answer {
        std::vector<user_shader::Complaint> complaints;
        int iterations = 0;
    };
    const Answer& ask(const std::vector<shading::TextChunk>& texts,
                      const std::vector<user_shader::Control>& controls,
                      const shading::ChunkSource& chunks);
    std::map<std::string, Answer> answers_;
};

}  // namespace volcast::scene
