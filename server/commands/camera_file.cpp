#include "server/commands/camera_file.h"

#include <cmath>

#include <boost/json.hpp>

namespace volcast::commands {

namespace {

namespace json = boost::json;

Error wrong(const std::string& key, const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, "key \"" + key + "\": " + what, key);
}

Result<double> number(const json::value& value, const std::string& key) {
    boost::system::error_code error;
    const auto result = value.to_number<double>(error);
    if (error || !std::isfinite(result)) return wrong(key, "is not a finite number");
    return result;
}

Result<glm::dvec3> vector(const json::value& value, const std::string& key) {
    const json::array* items = value.if_array();
    if (items == nullptr || items->size() != 3) return wrong(key, "is not a list of 3 numbers");
    glm::dvec3 result{0.0};
    for (int i = 0; i < 3; ++i) {
        const Result<double> item = number((*items)[static_cast<std::size_t>(i)], key);
        if (!item) return item.error();
        result[i] = *item;
    }
    return result;
}

Result<void> readVector(const json::object& object, const char* key, glm::dvec3& into) {
    const json::value* value = object.if_contains(key);
    if (value == nullptr) return wrong(key, "is missing");
    const auto read = vector(*value, key);
    if (!read) return read.error();
    into = *read;
    return {};
}

/// Leaves `into` alone where the key is absent.
Result<void> readNumber(const json::object& object, const char* key, double& into) {
    const json::value* value = object.if_contains(key);
    if (value == nullptr) return {};
    const auto read = number(*value, key);
    if (!read) return read.error();
    into = *read;
    return {};
}

Result<void> readProjection(const json::object& object, scene::Camera& camera) {
    const json::value* value = object.if_contains("projection");
    if (value == nullptr) return {};
    const bool text = value->is_string();
    if (text && value->get_string() == "orthographic") {
        camera.projection = scene::Projection::kOrthographic;
        return {};
    }
    if (text && value->get_string() == "perspective") return {};
    return wrong("projection", R"(is neither "perspective" nor "orthographic")");
}

Result<void> checkKeys(const json::object& object) {
    for (const auto& entry : object) {
        const std::string key{entry.key()};
        bool known = false;
        for (const char* name :
             {"eye", "center", "up", "fovy", "near", "far", "projection", "orthographic_height"}) {
            known = known || key == name;
        }
        if (!known) return wrong(key, "is not a key of a camera");
    }
    return {};
}

}  // namespace

Result<scene::Camera> parseCamera(std::string_view text) {
    boost::system::error_code error;
    const json::value document = json::parse({text.data(), text.size()}, error);
    if (error) return fail(ErrorCode::kInvalidArgument, "is not JSON: " + error.message());
    const json::object* object = document.if_object();
    if (object == nullptr) return fail(ErrorCode::kInvalidArgument, "is not a JSON object");

    scene::Camera camera;
    double ignored = 0.0;
    Result<void> done = checkKeys(*object);
    if (done) done = readVector(*object, "eye", camera.eye);
    if (done) done = readVector(*object, "center", camera.center);
    if (done) done = readVector(*object, "up", camera.up);
    if (done) done = readNumber(*object, "fovy", camera.fovyDegrees);
    if (done) done = readNumber(*object, "near", ignored);
    if (done) done = readNumber(*object, "far", ignored);
    if (done) done = readProjection(*object, camera);
    camera.orthographicHeight =
        2.0 * glm::length(camera.eye - camera.center) *
        std::tan(glm::radians(camera.fovyDegrees) / 2.0);  // Shows what the perspective shows.
    if (done) done = readNumber(*object, "orthographic_height", camera.orthographicHeight);
    if (done) done = scene::validate(camera);
    if (!done) return std::move(done).error();
    return camera;
}

}  // namespace volcast::commands
