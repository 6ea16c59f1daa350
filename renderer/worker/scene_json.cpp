#include "renderer/worker/scene_json.h"

#include <string>

#include <google/protobuf/util/json_util.h>

#include "renderer/worker/scene_message.h"

namespace volcast::worker {

Result<scene::Scene> sceneFromJson(
    std::string_view text, const std::function<scene::Layer(const std::string& field)>& defaults) {
    v1::Scene message;
    const auto status =
        google::protobuf::util::JsonStringToMessage({text.data(), text.size()}, &message);
    if (!status.ok()) {
        return fail(ErrorCode::kInvalidArgument, "not a scene: " + status.message().ToString());
    }
    for (v1::Layer& layer : *message.mutable_layers()) {
        scene::Scene carrier;
        carrier.layers.push_back(defaults(layer.field()));
        const v1::Scene filled = toMessage(carrier);
        layer.set_dataset(filled.layers(0).dataset());
        if (layer.transfer_function().points().empty()) {
            *layer.mutable_transfer_function() = filled.layers(0).transfer_function();
        }
    }
    return sceneFrom(message);
}

}  // namespace volcast::worker
