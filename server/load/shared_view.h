#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace volcast::load {

/// A view as the clients in it share it: who opened it sends its link and when it sent which input.
struct SharedView {
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t kInputsKept = 4096;

    unsigned members = 1;
    std::string link;                                   ///< Empty: not shared yet.
    std::vector<std::function<void()>> waiting;         ///< Called when there is a link.
    std::map<std::uint64_t, Clock::time_point> sentAt;  ///< By input_seq.

    void sent(std::uint64_t inputSeq) {
        sentAt[inputSeq] = Clock::now();
        if (sentAt.size() > kInputsKept) sentAt.erase(sentAt.begin());
    }
    void shared(const std::string& by) {
        link = by;
        for (const auto& join : std::exchange(waiting, {})) join();
    }
    /// Who opened it is gone; another view will take its place, and counts inputs anew.
    void lost() {
        link.clear();
        sentAt.clear();
    }
};

}  // namespace volcast::load
