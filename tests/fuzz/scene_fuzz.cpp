// A scene's document: read, checked, written, and read again to the same document.
#include <google/protobuf/util/json_util.h>

#include "renderer/worker/scene_message.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    v1::Scene message;
    const std::string text{fuzz::textOf(data, size)};
    if (!google::protobuf::util::JsonStringToMessage(text, &message).ok()) return 0;
    const auto scene = worker::sceneFrom(message);
    if (!scene) return 0;
    const v1::Scene written = worker::toMessage(*scene);
    const auto again = worker::sceneFrom(written);
    fuzz::require(again.has_value());
    fuzz::require(worker::toMessage(*again).SerializeAsString() == written.SerializeAsString());
    return 0;
}
