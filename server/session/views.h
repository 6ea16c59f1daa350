#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/session/shared_view.h"

namespace volcast::session {

/// All views of a server by their ids. Any thread.
class Views {
public:
    /// `parts` must outlive the views; clear() before they end.
    explicit Views(ViewParts parts) : parts_{parts} {}
    Views(const Views&) = delete;
    Views& operator=(const Views&) = delete;
    Views(Views&&) = delete;
    Views& operator=(Views&&) = delete;
    ~Views() { clear(); }

    /// A new view as `message` wants it. Errors: as ViewScene::open.
    Result<std::shared_ptr<SharedView>> open(const v1::OpenView& message);
    /// Ends the view if nobody is in it.
    void released(const std::shared_ptr<SharedView>& view);
    /// Ends all views.
    void clear();

private:
    const ViewParts parts_;
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<SharedView>> views_;
};

}  // namespace volcast::session
