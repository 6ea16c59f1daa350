#include "server/load/report.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace volcast::load {

namespace {

namespace json = boost::json;

constexpr double kMb = 1e6;

template <class... Values>
std::string format(const char* pattern, Values... values) {
    std::string text(256, '\0');
    const int size = std::snprintf(text.data(), text.size(), pattern, values...);
    text.resize(std::min(text.size() - 1, static_cast<std::size_t>(std::max(size, 0))));
    return text;
}

std::uint64_t errorsOf(const Stats& stats) {
    std::uint64_t sum = 0;
    for (const auto& [what, count] : stats.errors) sum += count;
    return sum;
}

double perSecond(double count, const Outcome& outcome) {
    return outcome.seconds > 0 ? count / outcome.seconds : 0;
}

struct Rates {
    double slowest = 0, fastest = 0;
};

Rates ratesOf(const std::vector<std::uint64_t>& frames, const Outcome& outcome) {
    if (frames.empty()) return {};
    const auto [least, most] = std::ranges::minmax(frames);
    return {perSecond(static_cast<double>(least), outcome),
            perSecond(static_cast<double>(most), outcome)};
}

/// 1: all alike; 0: one gets nothing, or there is none.
double fairness(const Rates& rates) {
    return rates.fastest > 0 ? rates.slowest / rates.fastest : 0;
}

double growthMb(const Outcome& outcome) {
    return (static_cast<double>(outcome.after.treeBytes) -
            static_cast<double>(outcome.before.treeBytes)) /
           kMb;
}

double growth(unsigned before, unsigned after) {
    return static_cast<double>(after) - before;
}

json::object quantiles(const Histogram& histogram) {
    return {{"count", histogram.count()},        {"mean", histogram.meanMs()},
            {"p50", histogram.quantileMs(0.50)}, {"p95", histogram.quantileMs(0.95)},
            {"p99", histogram.quantileMs(0.99)}, {"max", histogram.maxMs()}};
}

json::object kindJson(const Stats& stats, const Outcome& outcome) {
    const Rates rates = ratesOf(stats.framesByClient, outcome);
    json::object errors;
    for (const auto& [what, count] : stats.errors) errors[what] = count;
    json::value scale, quality;  // null where no frame says
    if (stats.leastScale) scale = *stats.leastScale;
    if (stats.leastQuality) quality = *stats.leastQuality;
    return {{"clients", stats.clients},
            {"connects", stats.connects},
            {"failed_connects", stats.failedConnects},
            {"lost_connections", stats.lostConnections},
            {"frames", stats.frames},
            {"bytes", stats.bytes},
            {"frames_per_s_slowest", rates.slowest},
            {"frames_per_s_fastest", rates.fastest},
            {"scale_least", std::move(scale)},
            {"quality_least", std::move(quality)},
            {"inputs", stats.inputs},
            {"overtaken", stats.overtaken},
            {"unanswered", stats.unanswered.count()},
            {"unanswered_ms", quantiles(stats.unanswered)},
            {"unseen_ms", quantiles(stats.unseen)},
            {"input_to_frame_ms", quantiles(stats.inputToFrame)},
            {"age_ms", quantiles(stats.age)},
            {"first_frame_ms", quantiles(stats.firstFrame)},
            {"errors", std::move(errors)}};
}

json::object useJson(const TreeUse& use) {
    return {{"resident_bytes", use.rootBytes},
            {"resident_bytes_with_workers", use.treeBytes},
            {"processes", use.processes},
            {"threads", use.rootThreads},
            {"threads_with_workers", use.treeThreads},
            {"descriptors", use.rootDescriptors},
            {"descriptors_with_workers", use.treeDescriptors}};
}

json::object serverJson(const Outcome& outcome) {
    json::object all = useJson(outcome.most);
    const double own = outcome.after.rootCpuS - outcome.before.rootCpuS;
    const double children = outcome.after.childrenCpuS - outcome.before.childrenCpuS;
    all["cpu_s"] = own;
    all["workers_cpu_s"] = children;
    all["streaming_share"] = own + children > 0 ? own / (own + children) : 0;
    all["start"] = useJson(outcome.before);
    all["end"] = useJson(outcome.after);
    return all;
}

std::string latencies(const Histogram& histogram) {
    return format("%7.0f%7.0f%7.0f%7.0f", histogram.quantileMs(0.50), histogram.quantileMs(0.95),
                  histogram.quantileMs(0.99), histogram.maxMs());
}

std::string rowOf(const std::string& kind, const Stats& stats, const Outcome& outcome) {
    const Rates rates = ratesOf(stats.framesByClient, outcome);
    const auto bytes = static_cast<double>(stats.bytes);
    return format("%-16s %7u  %7.1f %7.1f ", kind.c_str(), stats.clients, rates.slowest,
                  rates.fastest) +
           latencies(stats.inputToFrame) + " " + latencies(stats.age) +
           format("  %9llu %7.2f %8.1f  %6llu\n", static_cast<unsigned long long>(stats.overtaken),
                  perSecond(bytes / kMb, outcome),
                  stats.frames == 0 ? 0.0 : bytes / 1e3 / static_cast<double>(stats.frames),
                  static_cast<unsigned long long>(errorsOf(stats)));
}

std::string paceText(const Stats& stats) {
    std::string text;
    if (stats.leastScale) text += format("; scale at least %.2f", *stats.leastScale);
    if (stats.leastQuality) text += format("; JPEG quality at least %u", *stats.leastQuality);
    return text;
}

std::string missingText(const Stats& stats) {
    if (stats.unanswered.count() == 0) return {};
    return format("; %llu inputs unanswered, waiting %.0f ms (p50), %.0f ms (max)",
                  static_cast<unsigned long long>(stats.unanswered.count()),
                  stats.unanswered.quantileMs(0.5), stats.unanswered.maxMs());
}

std::string useText(const char* when, const TreeUse& use) {
    return format(
        "  %-6s %6.0f MB resident, %6.0f with workers; %3u threads, %3u with workers; %4u "
        "descriptors, %4u with workers; %u processes\n",
        when, static_cast<double>(use.rootBytes) / kMb, static_cast<double>(use.treeBytes) / kMb,
        use.rootThreads, use.treeThreads, use.rootDescriptors, use.treeDescriptors, use.processes);
}

/// Durations, and what was still open, with its time so far: no quantile is below that of either.
struct Waits {
    Histogram done, all;

    void merge(const Histogram& ended, const Histogram& open) {
        done.merge(ended);
        all.merge(ended);
        all.merge(open);
    }
    [[nodiscard]] double quantileMs(double share) const {
        return std::max(done.quantileMs(share), all.quantileMs(share));
    }
    [[nodiscard]] std::string open() const {
        const auto count = static_cast<unsigned long long>(all.count() - done.count());
        return count == 0 ? "" : format(", %llu of them still open", count);
    }
};

}  // namespace

std::vector<std::string> violations(const Outcome& outcome, const Thresholds& thresholds) {
    Waits inputToFrame, age;
    std::uint64_t errors = 0;
    for (const auto& [kind, stats] : outcome.kinds) {
        inputToFrame.merge(stats.inputToFrame, stats.unanswered);
        age.merge(stats.age, stats.unseen);
        errors += errorsOf(stats);
    }
    std::vector<std::string> all;
    const auto atMost = [&all](const char* what, double value, const std::optional<double>& limit,
                               const std::string& more = {}) {
        if (limit && value > *limit)
            all.push_back(format("%s: %.4g, more than %.4g%s", what, value, *limit, more.c_str()));
    };
    const auto wait = [&atMost](const char* what, const Waits& waits, double share,
                                const std::optional<double>& limit) {
        atMost(what, waits.quantileMs(share), limit, waits.open());
    };
    wait("input to frame p50 ms", inputToFrame, 0.50, thresholds.maxP50Ms);
    wait("input to frame p95 ms", inputToFrame, 0.95, thresholds.maxP95Ms);
    wait("input to frame p99 ms", inputToFrame, 0.99, thresholds.maxP99Ms);
    wait("frame age p99 ms", age, 0.99, thresholds.maxAgeP99Ms);
    wait("frame age max ms", age, 1, thresholds.maxAgeMs);
    atMost("errors", static_cast<double>(errors), thresholds.maxErrors);
    atMost("server MB", static_cast<double>(outcome.most.treeBytes) / kMb, thresholds.maxServerMb);
    atMost("server cores", perSecond(outcome.after.rootCpuS - outcome.before.rootCpuS, outcome),
           thresholds.maxServerCores);
    atMost("growth in MB", growthMb(outcome), thresholds.maxGrowthMb);
    atMost("more descriptors",
           growth(outcome.before.treeDescriptors, outcome.after.treeDescriptors),
           thresholds.maxGrowthDescriptors);
    atMost("more threads", growth(outcome.before.treeThreads, outcome.after.treeThreads),
           thresholds.maxGrowthThreads);
    // What was not seen at all keeps no limit.
    const bool wantsLatency = thresholds.maxP50Ms || thresholds.maxP95Ms || thresholds.maxP99Ms;
    if (wantsLatency && inputToFrame.done.count() == 0)
        all.emplace_back("input to frame: no frame answered an input");
    if ((thresholds.maxAgeP99Ms || thresholds.maxAgeMs) && age.done.count() == 0)
        all.emplace_back("frame age: no frame showed a new input");
    const auto atLeast = [&all](const char* what, double value,
                                const std::optional<double>& limit) {
        if (limit && value < *limit)
            all.push_back(format("%s: %.4g, less than %.4g", what, value, *limit));
    };
    atLeast("frames/s of the slowest client", ratesOf(outcome.movingFrames, outcome).slowest,
            thresholds.minFps);
    atLeast("fairness of views", fairness(ratesOf(outcome.steeredFrames, outcome)),
            thresholds.minFairness);
    return all;
}

std::string reportText(const LoadSettings& settings, const Outcome& outcome) {
    std::ostringstream text;
    text << format("%s:%u, %u views, %g inputs/s, %u x %u, measured %.1f s%s\n\n",
                   settings.url.host.c_str(), unsigned{settings.url.port}, outcome.views,
                   settings.inputsPerSecond, settings.width, settings.height, outcome.seconds,
                   outcome.interrupted ? " (interrupted)" : "");
    text << "                          frames/s a client  input to frame, ms             age, ms"
            "\nkind             clients  slowest fastest     p50    p95    p99    max"
            "     p50    p95    p99    max  overtaken    MB/s KB/frame  errors\n";
    for (const auto& [kind, stats] : outcome.kinds) {
        text << rowOf(kind, stats, outcome);
    }
    if (!outcome.steeredFrames.empty()) {
        const Rates rates = ratesOf(outcome.steeredFrames, outcome);
        text << format("\n%zu views move: %.1f to %.1f frames/s, fairness %.2f\n",
                       outcome.steeredFrames.size(), rates.slowest, rates.fastest, fairness(rates));
    }
    for (const auto& [kind, stats] : outcome.kinds) {
        text << format(
            "\n%s: %llu connects (%llu failed, %llu lost), first frame after %.0f ms (p50), %.0f "
            "ms (max)",
            kind.c_str(), static_cast<unsigned long long>(stats.connects),
            static_cast<unsigned long long>(stats.failedConnects),
            static_cast<unsigned long long>(stats.lostConnections),
            stats.firstFrame.quantileMs(0.5), stats.firstFrame.maxMs());
        text << paceText(stats) << missingText(stats);
        for (const auto& [what, count] : stats.errors) {
            text << "\n  " << count << " x " << what;
        }
    }
    text << '\n';
    if (outcome.serverMeasured) {
        const double own = outcome.after.rootCpuS - outcome.before.rootCpuS;
        const double all = outcome.after.cpuS() - outcome.before.cpuS();
        text << format(
            "\nserver: streaming %.2f cores, its workers %.2f; streaming is %.0f %% of both\n",
            perSecond(own, outcome), perSecond(all - own, outcome),
            all > 0 ? 100 * own / all : 0.0);
        text << useText("start", outcome.before) << useText("end", outcome.after)
             << useText("most", outcome.most);
    }
    return text.str();
}

json::object reportJson(const LoadSettings& settings, const Outcome& outcome,
                        const std::vector<std::string>& violated) {
    json::object kinds;
    for (const auto& [kind, stats] : outcome.kinds) kinds[kind] = kindJson(stats, outcome);
    const Rates rates = ratesOf(outcome.steeredFrames, outcome);
    json::object moving{{"count", outcome.steeredFrames.size()},
                        {"frames_per_s_slowest", rates.slowest},
                        {"frames_per_s_fastest", rates.fastest},
                        {"fairness", fairness(rates)}};
    json::object report{{"host", settings.url.host},
                        {"port", settings.url.port},
                        {"views", outcome.views},
                        {"inputs_per_s", settings.inputsPerSecond},
                        {"size", json::array{settings.width, settings.height}},
                        {"seconds", outcome.seconds},
                        {"interrupted", outcome.interrupted},
                        {"kinds", std::move(kinds)},
                        {"views_that_move", std::move(moving)},
                        {"violations", json::array(violated.begin(), violated.end())}};
    if (outcome.serverMeasured) report["server"] = serverJson(outcome);
    return report;
}

}  // namespace volcast::load
