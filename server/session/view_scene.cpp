#include "server/session/view_scene.h"

#include <algorithm>
#include <set>
#include <utility>

#include "renderer/scene/default_scene.h"
#include "renderer/scene/user_controls.h"
#include "renderer/scene/validate.h"
#include "renderer/worker/scene_message.h"

namespace volcast::session {

namespace {

std::vector<std::string> datasetsOf(const scene::Scene& scene) {
    std::set<std::string> ids;
    for (const scene::Layer& layer : scene.layers) ids.insert(layer.dataset);
    return {ids.begin(), ids.end()};
}

bool shownByCode(const scene::Layer& layer) {
    return layer.visible && scene::runsUserCode(layer);
}

/// The codes that a scene runs.
std::vector<std::string> codesOf(const scene::Scene& scene) {
    std::vector<std::string> codes;
    for (const scene::Layer& layer : scene.layers) {
        if (shownByCode(layer)) codes.push_back(layer.shader.code);
    }
    return codes;
}

scene::Scene withoutCode(scene::Scene scene) {
    for (scene::Layer& layer : scene.layers) {
        if (shownByCode(layer)) layer.visible = false;
    }
    return scene;
}

/// The error with its field as a path from the message.
Error within(const std::string& part, Error error) {
    if (error.field.empty()) {
        error.field = part;
    } else if (!error.field.starts_with(part + ".") && error.field != part) {
        error.field = part + "." + error.field;
    }
    return error;
}

}  // namespace

std::vector<std::string> ViewScene::Waiting::datasets() const {
    return scene ? datasetsOf(*scene) : std::vector{defaultOf};
}

Result<scene::PictureSize> sizeFrom(const v1::Viewport& message, std::uint64_t maxPixels) {
    // Beyond int the side is too long anyway, and says so as the largest int.
    const auto side = [](std::uint32_t pixels) {
        return static_cast<int>(std::min(pixels, std::uint32_t{0x7fffffff}));
    };
    const scene::PictureSize size{side(message.width()), side(message.height())};
    if (const auto valid = scene::validate(size); !valid) return within("viewport", valid.error());
    const std::uint64_t pixels = std::uint64_t{message.width()} * message.height();
    if (pixels > maxPixels) {
        return fail(ErrorCode::kLimitExceeded,
                    "a view of " + std::to_string(pixels) + " pixels; the limit is " +
                        std::to_string(maxPixels),
                    "viewport");
    }
    return size;
}

Result<scene::Scene> readyScene(const v1::Scene& message, Catalogue& catalogue) {
    auto scene = worker::sceneFrom(message);
    if (!scene) return std::move(scene).error();
    for (const std::string& id : datasetsOf(*scene)) {
        const auto standing = catalogue.require(id);
        if (!standing) return fail(standing.error().code, standing.error().message, "layers");
        if (!standing->loaded) {
            return fail(ErrorCode::kNotFound, id + " is not loaded yet", "layers");
        }
    }
    const auto summaries = catalogue.summaries(datasetsOf(*scene));
    if (auto valid = scene::validate(*scene, summaries); !valid) return std::move(valid).error();
    return scene;
}

Result<bool> ViewScene::require(const Waiting& next) {
    bool loaded = true;
    for (const std::string& id : next.datasets()) {
        const auto standing = catalogue_.require(id);
        if (!standing) {
            const std::string path = next.scene ? "scene.layers" : "dataset";
            return fail(standing.error().code, standing.error().message, path);
        }
        loaded = loaded && standing->loaded;
    }
    return loaded;
}

Result<scene::Scene> ViewScene::resolve(const Waiting& next) const {
    const scene::Summaries summaries = catalogue_.summaries(next.datasets());
    scene::Scene scene;
    if (next.scene) {
        scene = *next.scene;
    } else {
        scene = scene::defaultScene(next.defaultOf, summaries.at(next.defaultOf));
        if (next.camera) scene.camera = *next.camera;
    }
    if (const auto valid = scene::validate(scene, summaries); !valid) {
        return within("scene", valid.error());
    }
    return scene;
}

Result<SceneChange> ViewScene::accept(Waiting next) {
    const DatasetHold held = catalogue_.hold(next.datasets());  // From before it is asked for.
    const auto loaded = require(next);
    if (!loaded) return loaded.error();
    if (!*loaded) {
        waiting_ = std::move(next);
        hold();
        return SceneChange::kWaiting;
    }
    auto scene = resolve(next);
    if (!scene) return scene.error();
    waiting_.reset();
    take(std::move(*scene));
    return SceneChange::kDraw;
}

Result<SceneChange> ViewScene::open(const v1::OpenView& message) {
    Waiting next;
    if (message.has_scene()) {
        auto scene = worker::sceneFrom(message.scene());
        if (!scene) return within("scene", scene.error());
        next.scene = std::move(*scene);
    } else if (!message.dataset().empty()) {
        next.defaultOf = message.dataset();
    } else {
        const v1::DatasetList list = catalogue_.list();
        if (list.datasets().empty()) {
            return fail(ErrorCode::kNotFound, "the data folder holds nothing to show", "dataset");
        }
        next.defaultOf = list.datasets(0).id();
    }
    const auto change = accept(std::move(next));
    if (!change) return change.error();
    inputSeq_ = sceneSeq_ = message.input_seq();
    return *change;
}

Result<SceneChange> ViewScene::update(const v1::Update& message) {
    if (message.input_seq() <= inputSeq_) return SceneChange::kNone;
    std::optional<scene::Camera> camera;
    if (message.has_camera()) {
        const auto wanted = worker::cameraFrom(message.camera());
        if (!wanted) return within("camera", wanted.error());
        camera = *wanted;
    }
    SceneChange change = scene_ ? SceneChange::kDraw : SceneChange::kWaiting;
    if (scene_ && !waiting_ && !message.has_scene() && (!camera || *camera == scene_->camera)) {
        change = SceneChange::kSame;
    }
    if (message.has_scene()) {
        auto scene = worker::sceneFrom(message.scene());
        if (!scene) return within("scene", scene.error());
        if (camera) scene->camera = *camera;
        if (scene_ && !waiting_ && *scene == *scene_) {
            inputSeq_ = message.input_seq();
            return SceneChange::kSame;
        }
        auto accepted = accept({.scene = std::move(*scene), .seqBefore = shownSeq()});
        if (!accepted) return accepted.error();
        change = *accepted;
    }
    if (camera && scene_) scene_->camera = *camera;
    if (camera && waiting_) {
        if (waiting_->scene) waiting_->scene->camera = *camera;
        waiting_->camera = camera;
    }
    inputSeq_ = message.input_seq();
    if (message.has_scene()) sceneSeq_ = inputSeq_;
    return change;
}

Result<SceneChange> ViewScene::put(scene::Scene scene, std::uint64_t seq) {
    const auto change = accept({.scene = std::move(scene), .seqBefore = shownSeq()});
    if (!change) return change.error();
    inputSeq_ = sceneSeq_ = seq;
    return *change;
}

bool ViewScene::advance(std::uint64_t seq) {
    if (seq <= inputSeq_) return false;
    inputSeq_ = seq;
    return true;
}

Result<SceneChange> ViewScene::datasetChanged(const std::string& id) {
    if (waiting_ && std::ranges::count(waiting_->datasets(), id) != 0) {
        const std::vector<std::string> needed = waiting_->datasets();
        const DatasetStanding standing = catalogue_.standing(id);
        if (!standing.loaded && standing.failed) return fail(ErrorCode::kIo, standing.error);
        if (catalogue_.summaries(needed).size() < needed.size()) return SceneChange::kNone;
        auto scene = resolve(*waiting_);
        waiting_.reset();
        if (!scene) {
            hold();
            return scene.error();
        }
        take(std::move(*scene));
        return SceneChange::kDraw;
    }
    if (!scene_ || std::ranges::count(datasetsOf(*scene_), id) == 0) return SceneChange::kNone;
    if (dataVersion() == seenVersion_) return SceneChange::kNone;  // News of what was drawn.
    seenVersion_ = dataVersion();
    const auto valid = scene::validate(*scene_, catalogue_.summaries(datasetsOf(*scene_)));
    if (!valid) return within("scene", valid.error());
    return SceneChange::kDraw;
}

void ViewScene::take(scene::Scene scene) {
    scene_ = std::move(scene);
    seenVersion_ = dataVersion();
    isGood_ = false;
    hold();
}

void ViewScene::hold() {
    std::vector<std::string> all = datasets();
    for (const auto* scene : {&good_, &other_}) {
        if (*scene) std::ranges::copy(datasetsOf(**scene), std::back_inserter(all));
    }
    hold_ = catalogue_.hold(std::move(all));
}

void ViewScene::drawn(std::uint64_t seq) {
    if (isGood_ || seq < sceneSeq_) return;
    if (good_ && codesOf(*good_) != codesOf(*scene_)) other_ = std::move(good_);
    good_ = scene_;
    isGood_ = true;
    hold();
}

std::optional<std::uint64_t> ViewScene::revert() {
    if (!scene_ || !good_ || (isGood_ && codesOf(*scene_).empty())) return std::nullopt;
    const scene::Camera camera = scene_->camera;
    if (isGood_) {
        good_ = other_ ? std::exchange(other_, std::nullopt) : withoutCode(*scene_);
    }
    scene_ = good_;
    scene_->camera = camera;
    isGood_ = true;
    hold();
    return sceneSeq_;
}

std::vector<std::string> ViewScene::datasets() const {
    std::vector<std::string> all = scene_ ? datasetsOf(*scene_) : std::vector<std::string>{};
    if (waiting_) std::ranges::copy(waiting_->datasets(), std::back_inserter(all));
    return all;
}

std::uint64_t ViewScene::dataVersion() const {
    std::uint64_t sum = 0;
    if (!scene_) return sum;
    for (const std::string& id : datasetsOf(*scene_)) sum += catalogue_.standing(id).version;
    return sum;
}

}  // namespace volcast::session
