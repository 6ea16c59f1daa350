#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/session/link.h"
#include "server/session/person_book.h"
#include "server/session/shared_view.h"
#include "server/session/state_folder.h"

namespace volcast::session {

struct ViewsDesc {
    ViewParts parts;  ///< Must outlive the views.
    LinkKey key;
    std::chrono::seconds keep{60};  ///< So long a view waits for people who lost their connection.
    std::size_t maxViews = 1024;
    std::unique_ptr<StateFolder> state = {};  ///< Null: views do not outlive the server.
};

/// All views of a server by their ids, the links to them, and the people in them. Any thread.
class Views {
public:
    /// clear() before the parts end.
    explicit Views(ViewsDesc desc);
    Views(const Views&) = delete;
    Views& operator=(const Views&) = delete;
    Views(Views&&) = delete;
    Views& operator=(Views&&) = delete;
    ~Views();

    /// A new view as `message` wants it. Errors: as ViewScene::open; kLimitExceeded where there are
    /// too many; kIo.
    Result<std::shared_ptr<SharedView>> open(const v1::OpenView& message);
    /// A link to `view`; it is kept for a while when people leave it. Errors: kIo.
    Result<std::string> share(const SharedView& view, v1::Role role,
                              std::chrono::system_clock::time_point expires);
    /// The view that a link read by link() leads to, if there still is one.
    std::shared_ptr<SharedView> find(const std::string& id);
    /// Errors: as readLink().
    [[nodiscard]] Result<Link> link(const std::string& text) const;
    /// What an access token allows. Errors: as readAccess().
    [[nodiscard]] Result<Access> access(const std::string& token) const;
    /// Somebody left: ends the view where it is for nobody any more.
    void left(const std::shared_ptr<SharedView>& view);
    /// Ends the views that nobody has been in for `keep`; to be called now and then.
    void tidy();
    /// Saves and ends all views.
    void clear();

    [[nodiscard]] std::size_t size();
    /// Pictures that no encoder's thread has begun.
    [[nodiscard]] std::size_t picturesToEncode();
    [[nodiscard]] PersonBook& people() noexcept { return people_; }
    [[nodiscard]] std::chrono::seconds keep() const noexcept { return desc_.keep; }
    [[nodiscard]] std::size_t maxPeople() const noexcept { return desc_.parts.maxPeople; }

private:
    struct Entry {
        std::shared_ptr<SharedView> view;
        bool shared = false;  ///< A link was given out.
    };
    using Entries = std::map<std::string, Entry>;
    void restore();
    [[nodiscard]] std::optional<SavedView> saved(const std::string& id);
    void sweep(TimePoint now);
    bool makeRoom();
    Entries::iterator erase(Entries::iterator entry);

    ViewsDesc desc_;
    PersonBook people_;
    std::mutex mutex_;
    Entries views_;
};

}  // namespace volcast::session
