#include "tests/unit/protocol/vector_cases.h"

#include <cstdlib>
#include <span>
#include <stdexcept>
#include <utility>

#include <google/protobuf/util/json_util.h>

#include "protocol/framing.h"
#include "volcast/v1/session.pb.h"

namespace volcast::protocol {

namespace {

/// Name and canonical JSON of one message.
using Meaning = std::pair<const char*, const char*>;

constexpr const char* kScene =
    R"({"camera":{"eye":{"z":3},"center":{},"up":{"y":1},"fovyDegrees":30},"layers":[)"
    R"({"id":"wing","dataset":"blunt/fin.vtu","field":"Density","timeStep":2,)"
    R"("model":"RAY_MODEL_VOLUME","transferFunction":{"points":[)"
    R"({"value":0.125,"colour":{"b":1}},)"
    R"({"value":4.5,"colour":{"r":1,"g":0.5},"extinction":2.25}]},)"
    R"("integrator":"INTEGRATOR_AVERAGE"},)"
    R"({"id":"skin","dataset":"blunt/fin.vtu","model":"RAY_MODEL_SURFACE","hidden":true,)"
    R"("surfaceColour":{"r":0.25,"g":0.25,"b":0.25},"unlit":true},)"
    R"({"id":"scan","dataset":"iron.mhd","model":"RAY_MODEL_MIP","stepWorld":0.5,)"
    R"("sampling":"SAMPLING_NEAREST"}],)"
    R"("background":{"r":0.5,"g":0.5,"b":0.5},"backgroundTransparency":1})";

std::vector<std::pair<std::string, std::string>> clientMeanings() {
    const std::string scene = kScene;
    return {
        {"hello_minimal", R"({"hello":{"major":1}})"},
        {"hello_full", R"({"hello":{"major":1,"minor":3,"client":"probe 0.1 é",)"
                       R"("codecs":["CODEC_PNG","CODEC_JPEG"]}})"},
        {"describe_shader", R"({"describeShader":{"request":3,"code":"void main() {}",)"
                            R"("dataset":"v"}})"},
        {"open_dataset", R"({"openDataset":{"dataset":"blunt/fin.vtu"}})"},
        {"open_view_default",
         R"({"openView":{"view":1,"viewport":{"width":512,"height":384},"inputSeq":"1"}})"},
        {"open_view_scene", R"({"openView":{"view":7,"scene":)" + scene +
                                R"(,"viewport":{"width":8192,"height":1},"inputSeq":"1"}})"},
        {"update_camera",
         R"({"update":{"view":7,"inputSeq":"2","camera":{"eye":{"x":-1.5,"y":1e-30,"z":1e+30},)"
         R"("center":{"x":0.1},"up":{"z":1},"projection":"PROJECTION_ORTHOGRAPHIC",)"
         R"("orthographicHeight":2.5}}})"},
        {"update_viewport", R"({"update":{"view":4294967295,"inputSeq":"18446744073709551615",)"
                            R"("viewport":{"width":1,"height":1}}})"},
        {"update_scene",
         R"({"update":{"view":7,"inputSeq":"9007199254740993","scene":)" + scene + "}}"},
        {"update_nothing", R"({"update":{"view":7,"inputSeq":"4"}})"},
        {"close_view", R"({"closeView":{"view":7}})"},
        {"ack", R"({"ack":{"view":7,"sequence":41,"holdUs":16700,"decodeUs":4700,"queue":1}})"},
        {"ack_keyframe", R"({"ack":{"view":7,"sequence":42,"keyframe":true}})"},
        {"set_pins", R"({"setPins":{"view":7,"pins":{"quality":80,"scale":0.5,"framesPerS":24,)"
                     R"("fullAccuracy":true,"codec":"CODEC_VP9"}}})"},
        {"set_pins_none", R"({"setPins":{"view":7,"pins":{}}})"},
        {"patch_decoded", R"({"patchDecoded":{"codec":"CODEC_H264","rgb":"AAAA/////wAA"}})"},
        {"patch_failed", R"({"patchDecoded":{"codec":"CODEC_VP9","error":"not supported"}})"},
        {"pick", R"({"pick":{"view":7,"inputSeq":"9007199254740993","x":8191,"y":12}})"},
        {"measure_difference",
         R"({"measureDifference":{"view":7,"maxPixels":65536,"maxMs":20000}})"},
        {"measure_difference_stop", R"({"measureDifference":{"view":7,"stop":true}})"},
        {"measure_accuracy_estimate", R"({"measureAccuracy":{"view":7,"estimate":true}})"},
        {"draw_thumbnail", R"({"drawThumbnail":{"view":7,"request":3,"scene":{"layers":[{)"
                           R"("id":"main","model":"RAY_MODEL_MIP"}]},"width":96,"height":72}})"},
        {"inject_fault", R"({"injectFault":{"view":7,"fault":"crash"}})"},
        {"ping", R"({"ping":{"token":"9007199254740993"}})"},
        {"hello_again", R"({"hello":{"major":1,"minor":2,"person":"Zoë","resume":"a-b_c"}})"},
        {"open_view_link", R"({"openView":{"view":2,"viewport":{"width":64,"height":48},)"
                           R"("link":"AQI-_w"}})"},
        {"share_view", R"({"shareView":{"view":2,"role":"ROLE_WATCH","expiresS":3600}})"},
        {"take_control", R"({"takeControl":{"view":2}})"},
        {"hand_over", R"({"handOver":{"view":2,"person":4294967295}})"},
        {"ask_control", R"({"askControl":{"view":2}})"},
        {"ask_control_no_more", R"({"askControl":{"view":2,"withdraw":true}})"},
        {"set_name", R"({"setName":{"person":"Zoë"}})"},
        {"undo", R"({"undo":{"view":2}})"},
        {"redo", R"({"undo":{"view":2,"redo":true,"inputSeq":"9007199254740993"}})"},
        {"no_body", "{}"},
    };
}

std::vector<std::pair<std::string, std::string>> serverMeanings() {
    const std::string scene = kScene;
    return {
        {"welcome",
         R"({"welcome":{"major":1,"server":"volcast 0.1.0","codecs":["CODEC_JPEG","CODEC_PNG"],)"
         R"("meshModels":["RAY_MODEL_SURFACE","RAY_MODEL_VOLUME"],)"
         R"("volumeModels":["RAY_MODEL_MIP","RAY_MODEL_VOLUME"],)"
         R"("limits":{"maxViews":16,"maxSide":8192,"maxLayers":16,"maxControlPoints":1024,)"
         R"("maxMessageBytes":65536},"sourceUrl":"https://example.org/volcast"}})"},
        {"welcome_back", R"({"welcome":{"major":1,"minor":2,"limits":{"maxPeople":256},)"
                         R"("resume":"a-b_c","resumed":true,"person":7}})"},
        {"view_opened_again",
         R"({"viewOpened":{"view":2,"scene":)" + scene +
             R"(,"id":"hU7-_x","role":"ROLE_CONTROL","inputSeq":"41","canUndo":true}})"},
        {"scene_changed", R"({"sceneChanged":{"view":2,"scene":)" + scene +
                              R"(,"inputSeq":"42","person":7,"canUndo":true,"canRedo":true}})"},
        {"scene_changed_camera",
         R"({"sceneChanged":{"view":2,"inputSeq":"43","person":7,"canUndo":true,)"
         R"("camera":{"eye":{"x":-1.5},"center":{},"up":{"z":1},"fovyDegrees":30}}})"},
        {"view_shared", R"({"viewShared":{"view":2,"link":"AQI-_w","url":"/#link=AQI-_w",)"
                        R"("role":"ROLE_WATCH","expires":"1800000000"}})"},
        {"people", R"({"people":{"view":2,"people":[{"id":7,"name":"Zoë","role":"ROLE_CONTROL",)"
                   R"("steers":true},{"id":8,"name":"Guest 8","role":"ROLE_WATCH","away":true},)"
                   R"({"id":9,"role":"ROLE_WATCH","asks":true}]}})"},
        {"dataset_list_empty", R"({"datasetList":{}})"},
        {"dataset_list", R"({"datasetList":{"datasets":[{"id":"demo:mesh","name":"Demo mesh"},)"
                         R"({"id":"a b/é.vtu","name":"é.vtu","state":"DATASET_STATE_IMPORTING",)"
                         R"("progress":0.25,"stage":"reading"}]}})"},
        {"dataset_info_mesh",
         R"({"datasetInfo":{"id":"m","name":"m","state":"DATASET_STATE_READY",)"
         R"("kind":"DATASET_KIND_MESH","progress":1,"fields":[{"name":"T","unit":"K","min":-1.5,)"
         R"("max":2.5,"histogram":[1,0,300],"steps":3,)"
         R"("percentiles":[-1.5,0,2.5],"usualRange":{"min":-1,"max":2}},{"name":"id","association":)"
         R"("ASSOCIATION_CELL","max":9,"steps":1}],"boundsMin":{"x":-1},"boundsMax":)"
         R"({"x":1,"y":2,"z":3},"cells":"224874","vertices":"40960","bytes":"9007199254740993",)"
         R"("version":"2","warnings":["12 cells without volume left out"]}})"},
        {"dataset_info_volume",
         R"({"datasetInfo":{"id":"v","name":"v","state":"DATASET_STATE_READY",)"
         R"("kind":"DATASET_KIND_VOLUME","progress":1,"voxels":[68,68,68],"version":"1"}})"},
        {"dataset_info_failed",
         R"({"datasetInfo":{"id":"x.vtu","name":"x.vtu","state":"DATASET_STATE_FAILED",)"
         R"("error":"x.vtu: ends after 12 bytes"}})"},
        {"picked_cell",
         R"({"picked":{"view":7,"inputSeq":"41","x":8191,"y":12,"layer":"main","values":[)"
         R"({"field":"T","value":-1.5},{"field":"p","value":1e+30}],"position":{"x":1,"y":-2.5},)"
         R"("distance":3.25,"cell":0,"colour":{"r":0.5,"g":1}}})"},
        {"picked_voxel", R"({"picked":{"view":7,"inputSeq":"41","layer":"main","values":[)"
                         R"({"field":"f"}],"position":{},"voxel":[1,0,67],"colour":{}}})"},
        {"difference_report",
         R"({"differenceReport":{"view":7,"inputSeq":"41","width":4,"height":2,"step":1,)"
         R"("refines":true,"firstRow":1,"off":"ADwAAP97AHw=","pixels":"8","maxError":0.5,)"
         R"("rmsError":0.25,"shareOver255":0.125,"progress":1,"done":true}})"},
        {"difference_stopped",
         R"({"differenceReport":{"view":7,"done":true,"stopped":"the view changed"}})"},
        {"accuracy_estimated",
         R"({"accuracyReport":{"view":7,"done":true,"progress":1,"rows":[{"layer":"main",)"
         R"("integrator":"INTEGRATOR_AVERAGE","maxError":0.25,"medianMs":12.5}],)"
         R"("estimated":true}})"},
        {"thumbnail", R"({"thumbnail":{"view":7,"request":3,"codec":"CODEC_JPEG",)"
                      R"("picture":"/9j/"}})"},
        {"thumbnail_refused", R"({"thumbnail":{"view":7,"request":4,"refusal":"no memory"}})"},
        {"picked_nothing", R"({"picked":{"view":7,"inputSeq":"41","x":3,"y":4}})"},
        {"view_opened", R"({"viewOpened":{"view":7,"scene":)" + scene + "}}"},
        {"view_status_recovering",
         R"({"viewStatus":{"view":7,"state":"VIEW_STATE_RECOVERING","message":"worker lost"}})"},
        {"view_status_active", R"({"viewStatus":{"view":7}})"},
        {"error_field",
         R"({"error":{"code":"ERROR_CODE_INVALID_ARGUMENT","message":"eye.x is not finite",)"
         R"("field":"camera.eye.x","view":7,"inputSeq":"12"}})"},
        {"shader_description",
         R"({"shaderDescription":{"request":3,"controls":[{"name":"s","line":1,)"
         R"("slider":{"type":"float","min":-1,"max":1,"step":0.02}},{"name":"b","line":2,)"
         R"("checkbox":true},{"name":"t","line":3,"transferFunction":{"window":{"max":255},)"
         R"("points":[{"value":102,"colour":{}},{"value":178.5,"colour":{"r":1,"g":1,"b":1},)"
         R"("opacity":1}],"defaultColour":{"r":1,"g":1,"b":1}}}],)"
         R"("complaints":[{"line":4,"column":3,"message":"while is not allowed"}]}})"},
        {"error_dataset", R"({"error":{"code":"ERROR_CODE_IMPORT_FAILED","message":"x.vtu: empty",)"
                          R"("dataset":"x.vtu"}})"},
        {"pong", R"({"pong":{"token":"9007199254740993"}})"},
    };
}

constexpr Meaning kFrameHeaders[] = {
    {"jpeg", R"({"inputSeq":"12","width":512,"height":384,"codec":"CODEC_JPEG","planId":"5f1c",)"
             R"("integrators":["average"],"timings":{"waitMs":0.5,"uploadMs":0.25,"drawMs":39.5,)"
             R"("readbackMs":1.5,"encodeMs":0.875,"queueMs":0.0625},"dataVersion":"1",)"
             R"("workerGeneration":1,"redrawn":true})"},
    {"png_final",
     R"({"inputSeq":"9007199254740993","width":1,"height":1,"codec":"CODEC_PNG",)"
     R"("lossless":true,"final":true,"planId":"5f1c","integrators":["average","march"],)"
     R"("estimatedError":0,"timings":{},"dataVersion":"3","workerGeneration":4})"},
    {"webp_exact", R"({"inputSeq":"4","width":2,"height":2,"codec":"CODEC_WEBP","lossless":true,)"
                   R"("final":true,"ready":true,"pixelsXxh32":4276540828})"},
    {"vp9_paced", R"({"inputSeq":"5","width":256,"height":192,"codec":"CODEC_VP9","keyframe":true,)"
                  R"("pace":{"quality":75,"scale":0.5,"fullAccuracy":true,"framesPerS":15,)"
                  R"("window":2,"underWay":1,"rttMs":62.5,"rttMinMs":50,"queueDelayMs":12.5,)"
                  R"("bytesPerS":250000,"reason":"scale 0.75 to 0.5: queueing delay 84 ms"}})"},
    {"patch", R"({"width":128,"height":64,"codec":"CODEC_H264","keyframe":true,"patch":true})"},
};

std::string hexOf(std::span<const std::byte> bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    std::string hex;
    for (const std::byte byte : bytes) {
        hex += kDigits[std::to_integer<unsigned>(byte) >> 4U];
        hex += kDigits[std::to_integer<unsigned>(byte) & 15U];
    }
    return hex;
}

template <class Message>
Message messageFrom(const std::string& json) {
    Message message;
    const auto status = google::protobuf::util::JsonStringToMessage(json, &message);
    if (!status.ok()) throw std::runtime_error(json + ": " + status.ToString());
    return message;
}

template <class Message>
void addMessages(std::vector<VectorCase>& cases, const std::string& kind,
                 const std::vector<std::pair<std::string, std::string>>& meanings) {
    for (const auto& [name, json] : meanings) {
        const std::string bytes = messageFrom<Message>(json).SerializeAsString();
        std::string caseName = kind;
        caseName.append("_").append(name);
        cases.push_back({caseName, kind, hexOf(std::as_bytes(std::span{bytes})), json});
    }
}

/// A frame whose header's bytes are given, so that they can be wrong or of another version.
VectorCase frameCase(const std::string& name, const FramePrefix& prefix, const std::string& head,
                     const std::string& headerJson, const std::string& payloadHex) {
    const std::string hex = hexOf(encode(prefix)) + hexOf(std::as_bytes(std::span{head}));
    const std::string json =
        R"({"version":)" + std::to_string(prefix.version) + R"(,"type":)" +
        std::to_string(prefix.type) + R"(,"flags":)" + std::to_string(prefix.flags) +
        R"(,"headerBytes":)" + std::to_string(prefix.headerBytes) + R"(,"view":)" +
        std::to_string(prefix.view) + R"(,"sequence":)" + std::to_string(prefix.sequence) +
        R"(,"header":)" + headerJson + R"(,"payload":")" + payloadHex + R"("})";
    return {"frame_" + name, "frame", hex + payloadHex, json};
}

void addFrames(std::vector<VectorCase>& cases) {
    for (const auto& [name, json] : kFrameHeaders) {
        const std::string binary = messageFrom<v1::FrameHeader>(json).SerializeAsString();
        const std::string text = json;
        FramePrefix prefix{
            .headerBytes = static_cast<std::uint32_t>(binary.size()), .view = 7, .sequence = 41};
        cases.push_back(frameCase(std::string{name} + "_binary_header", prefix, binary, json,
                                  "ffd8ffe000ffd9"));
        prefix.flags = kJsonHeaderFlag;
        prefix.headerBytes = static_cast<std::uint32_t>(text.size());
        cases.push_back(
            frameCase(std::string{name} + "_json_header", prefix, text, json, "89504e47"));
    }
    cases.push_back(frameCase("empty", {}, "", "{}", ""));
    cases.push_back(frameCase("largest_numbers",
                              {.flags = 0xfffe, .view = 0xffffffffU, .sequence = 0xffffffffU}, "",
                              "{}", "00"));
    // Field 1000 (varint 5) of a later minor: to be skipped; then input_seq 3.
    const std::string later = "\xc0\x3e\x05\x08\x03";
    cases.push_back(frameCase("field_of_a_later_minor",
                              {.headerBytes = 5, .view = 1, .sequence = 1}, later,
                              R"({"inputSeq":"3"})", "01"));
}

void addInvalidFrames(std::vector<VectorCase>& cases) {
    const std::string good = "01010000000000000700000029000000";
    const auto add = [&cases](const std::string& name, const std::string& hex,
                              const std::string& reason) {
        cases.push_back(
            {"invalid_frame_" + name, "invalid_frame", hex, R"({"reason":")" + reason + R"("})"});
    };
    add("no_bytes", "", "shorter than the prefix");
    add("prefix_cut_short", good.substr(0, 30), "shorter than the prefix");
    add("version_0", "00" + good.substr(2), "another version");
    add("version_2", "02" + good.substr(2), "another version");
    add("type_0", "0100" + good.substr(4), "unknown type");
    add("type_2", "0102" + good.substr(4), "unknown type");
    add("header_one_byte_too_long", "01010000010000000700000029000000", "header past the end");
    add("header_of_4_gib", "01010000ffffffff070000002900000000", "header past the end");
    add("header_is_no_protobuf", "01010000020000000700000029000000ffff", "header does not parse");
    add("header_is_no_json", "010101000200000007000000290000007b7b", "header does not parse");
}

}  // namespace

std::vector<VectorCase> makeVectors() {
    std::vector<VectorCase> cases;
    addMessages<v1::ClientMessage>(cases, "client", clientMeanings());
    addMessages<v1::ServerMessage>(cases, "server", serverMeanings());
    addFrames(cases);
    addInvalidFrames(cases);
    return cases;
}

std::string vectorsFile(const std::vector<VectorCase>& cases) {
    std::string text = "[\n";
    for (const VectorCase& one : cases) {
        text += R"({"name":")" + one.name + R"(","kind":")" + one.kind + R"(","hex":")" + one.hex +
                R"(","json":)" + one.json + (&one == &cases.back() ? "}\n" : "},\n");
    }
    return text + "]\n";
}

std::vector<std::byte> bytesFromHex(const std::string& hex) {
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        bytes.push_back(
            static_cast<std::byte>(std::strtoul(hex.substr(i, 2).c_str(), nullptr, 16)));
    }
    return bytes;
}

}  // namespace volcast::protocol
