#include "renderer/scene/user_code.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/layer_fields.h"
#include "renderer/scene/scale.h"
#include "renderer/scene/user_controls.h"
#include "renderer/user_shader/generate.h"
#include "renderer/user_shader/texels.h"
#include "renderer/user_shader/tree_check.h"

namespace volcast::scene {
namespace {

using user_shader::ValueType;

// While code is written, each version of it leaves one.
constexpr std::size_t kMaxAnswers = 64;

/// Opacities are those of a 64th of the data's diagonal.
double referencesAWorldUnit(const data::DatasetSummary& summary) {
    constexpr double kReferences = 64.0;
    const double diagonal = glm::length(summary.bounds.max - summary.bounds.min);
    return diagonal > 0.0 ? kReferences / diagonal : 1.0;
}

/// What the ends of the layer's interval, and all values of maps, are relative to.
double intervalShift(const Layer& layer, const data::DatasetSummary& summary) {
    const FieldUse use = mainField(layer, summary);
    return -double{ScaleFunction{use.scale, use.field->range}.ofPoint(0.0F)};
}

}  // namespace

Result<UserCode> UserCodes::of(const Layer& layer, const data::DatasetSummary& summary,
                               const shading::ChunkSource& chunks, const std::string& path) {
    const Result<user_shader::Checked> code = resolved(layer.shader, path + ".shader");
    if (!code) return code.error();
    const ValueType type = valueType(summary);
    UserCode made;
    made.otherChannels = otherChannels(*code, layer, summary);
    made.texts = {{.path = user_shader::kValuesChunk,
                   .text = user_shader::valuesText(type, layer.model != RayModel::kCrossSections)},
                  {.path = user_shader::kControlsChunk,
                   .text = user_shader::controlsText(code->controls, made.otherChannels, type)},
                  {.path = user_shader::kBodyChunk, .text = code->body}};
    const Answer& answer = ask(made.texts, code->controls, chunks);
    if (!answer.complaints.empty()) return shaderError(answer.complaints, path + ".shader.code");
    made.iterations = answer.iterations;
    made.texels = user_shader::controlTexels(
        code->controls, type,
        {.referencesAWorldUnit = referencesAWorldUnit(summary) * std::exp(double{layer.gain}),
         .intervalShift = intervalShift(layer, summary)});
    return made;
}

const UserCodes::Answer& UserCodes::ask(const std::vector<shading::TextChunk>& texts,
                                        const std::vector<user_shader::Control>& controls,
                                        const shading::ChunkSource& chunks) {
    std::string key;
    for (const shading::TextChunk& chunk : texts) key += chunk.text + '\0';
    if (const auto known = answers_.find(key); known != answers_.end()) return known->second;
    if (answers_.size() >= kMaxAnswers) answers_.clear();
    Answer answer;
    const auto source = shading::expand("user/code.glsl", {}, shading::withTexts(texts, chunks));
    if (!source) {
        answer.complaints.push_back({.message = source.error().message});
    } else {
        const auto userLine = [&source](int number) {
            const auto index = static_cast<std::size_t>(number) - 1;
            const bool users = number > 0 && index < source->lines.size() &&
                               source->lines[index].file == user_shader::kBodyChunk;
            return users ? source->lines[index].line : 0;
        };
        user_shader::TreeReport report = user_shader::checkTree(
            {.source = source->source, .userLine = userLine, .controls = controls});
        answer = {.complaints = std::move(report.complaints), .iterations = report.iterations};
    }
    return answers_.emplace(std::move(key), std::move(answer)).first->second;
}

}  // namespace volcast::scene
