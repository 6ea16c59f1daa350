#include "server/session/saved_view.h"

#include <memory>
#include <utility>

#include <boost/json.hpp>
#include <google/protobuf/util/json_util.h>

#include "renderer/worker/scene_message.h"

namespace volcast::session {

namespace {

namespace json = boost::json;

constexpr int kFormat = 1;

json::value sceneJson(const scene::Scene& scene) {
    std::string text;
    (void)google::protobuf::util::MessageToJsonString(worker::toMessage(scene), &text);
    return json::parse(text);
}

Result<scene::Scene> sceneFrom(const json::value& document) {
    v1::Scene message;
    const auto read =
        google::protobuf::util::JsonStringToMessage(json::serialize(document), &message);
    if (!read.ok()) {
        return fail(ErrorCode::kInvalidArgument, "scene: " + std::string{read.message()});
    }
    return worker::sceneFrom(message);
}

json::array stepsJson(const std::vector<SceneHistory::ScenePtr>& steps) {
    json::array all;
    for (const auto& step : steps) all.push_back(sceneJson(*step));
    return all;
}

json::object personJson(const SavedView::Person& person) {
    return {{"id", person.member.person},
            {"name", person.member.name},
            {"role", v1::Role_Name(person.member.role)},
            {"steers", person.steers},
            {"view", person.member.number},
            {"width", person.member.size.x},
            {"height", person.member.size.y},
            {"token_hash", person.tokenHash}};
}

/// Throws what Boost.JSON throws for a value that is missing or of another type.
SavedView::Person personFrom(const json::object& object) {
    SavedView::Person person;
    person.member.person = object.at("id").to_number<std::uint32_t>();
    person.member.name = object.at("name").as_string().c_str();
    if (!v1::Role_Parse(object.at("role").as_string().c_str(), &person.member.role)) {
        throw std::invalid_argument{"role"};
    }
    person.member.number = object.at("view").to_number<std::uint32_t>();
    person.member.size = {object.at("width").to_number<int>(),
                          object.at("height").to_number<int>()};
    person.steers = object.at("steers").as_bool();
    person.tokenHash = object.at("token_hash").as_string().c_str();
    return person;
}

}  // namespace

std::string toJson(const SavedView& view) {
    json::array people;
    for (const SavedView::Person& person : view.people) people.push_back(personJson(person));
    const json::object document{{"volcast_view", kFormat},
                                {"id", view.id},
                                {"shared", view.shared},
                                {"input_seq", view.inputSeq},
                                {"people", std::move(people)},
                                {"scene", sceneJson(view.scene)},
                                {"undo", stepsJson(view.history.undo)},
                                {"redo", stepsJson(view.history.redo)}};
    return json::serialize(document) + "\n";
}

Result<SavedView> savedViewFromJson(const std::string& text) {
    // Boost.JSON throws: its home ends here.
    try {
        const json::object document = json::parse(text).as_object();
        if (document.at("volcast_view").to_number<int>() != kFormat) {
            return fail(ErrorCode::kInvalidArgument,
                        "volcast_view is not " + std::to_string(kFormat));
        }
        SavedView view;
        view.id = document.at("id").as_string().c_str();
        view.shared = document.at("shared").as_bool();
        view.inputSeq = document.at("input_seq").to_number<std::uint64_t>();
        for (const json::value& person : document.at("people").as_array()) {
            view.people.push_back(personFrom(person.as_object()));
        }
        auto scene = sceneFrom(document.at("scene"));
        if (!scene) return scene.error();
        view.scene = *std::move(scene);
        for (const auto& [key, steps] :
             {std::pair{"undo", &view.history.undo}, std::pair{"redo", &view.history.redo}}) {
            const json::value* saved = document.if_contains(key);  // Older files have none.
            if (saved == nullptr) continue;
            for (const json::value& step : saved->as_array()) {
                auto before = sceneFrom(step);
                if (!before) return before.error();
                steps->push_back(std::make_shared<const scene::Scene>(*std::move(before)));
            }
        }
        return view;
    } catch (const std::exception& error) {
        return fail(ErrorCode::kInvalidArgument, std::string{"not a saved view: "} + error.what());
    }
}

}  // namespace volcast::session
