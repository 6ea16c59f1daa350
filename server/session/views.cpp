#include "server/session/views.h"

#include <utility>

namespace volcast::session {

Result<std::shared_ptr<SharedView>> Views::open(const v1::OpenView& message) {
    auto view = SharedView::create(parts_);
    if (const auto opened = view->open(message); !opened) {
        view->end();
        return opened.error();
    }
    const std::lock_guard lock{mutex_};
    views_.emplace(view->id(), view);
    return view;
}

void Views::released(const std::shared_ptr<SharedView>& view) {
    if (!view->empty()) return;
    view->end();
    const std::lock_guard lock{mutex_};
    views_.erase(view->id());
}

void Views::clear() {
    std::map<std::string, std::shared_ptr<SharedView>> all;
    {
        const std::lock_guard lock{mutex_};
        all.swap(views_);
    }
    for (const auto& [id, view] : all) view->end();
}

}  // namespace volcast::session
