#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/scene/scene.h"
#include "server/session/scene_history.h"
#include "server/session/view_people.h"

namespace volcast::session {

/// What is kept of a view over a restart of the server.
struct SavedView {
    struct Person {
        Member member;
        bool steers = false;
        std::string tokenHash = {};  ///< PersonBook::tokenHash().
    };
    std::string id;
    bool shared = false;  ///< Links to it were given out.
    std::uint64_t inputSeq = 0;
    scene::Scene scene = {};
    SceneHistory::Saved history = {};
    std::vector<Person> people = {};
};

/// A JSON document; its scene is as clients read and write it.
std::string toJson(const SavedView& view);

/// Errors: kInvalidArgument saying what is not as toJson() writes it.
Result<SavedView> savedViewFromJson(const std::string& text);

}  // namespace volcast::session
