#include "server/load/report.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace volcast::load {

namespace {

namespace json = boost::json;

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

struct Slowest {
    double least = 0, most = 0;
};

Slowest framesPerSecond(const Stats& stats, const Outcome& outcome) {
    if (stats.framesByClient.empty()) return {};
    const auto [least, most] = std::ranges::minmax(stats.framesByClient);
    return {perSecond(static_cast<double>(least), outcome),
            perSecond(static_cast<double>(most), outcome)};
}

json::object quantiles(const Histogram& histogram) {
    return {{"count", histogram.count()},        {"mean", histogram.meanMs()},
            {"p50", histogram.quantileMs(0.50)}, {"p95", histogram.quantileMs(0.95)},
            {"p99", histogram.quantileMs(0.99)}, {"max", histogram.maxMs()}};
}

json::object kindJson(const Stats& stats, const Outcome& outcome) {
    const Slowest fps = framesPerSecond(stats, outcome);
    json::object errors;
    for (const auto& [what, count] : stats.errors) errors[what] = count;
    return {{"clients", stats.clients},
            {"connects", stats.connects},
            {"failed_connects", stats.failedConnects},
            {"lost_connections", stats.lostConnections},
            {"frames", stats.frames},
            {"bytes", stats.bytes},
            {"frames_per_s_slowest", fps.least},
            {"frames_per_s_fastest", fps.most},
            {"inputs", stats.inputs},
            {"overtaken", stats.overtaken},
            {"input_to_frame_ms", quantiles(stats.inputToFrame)},
            {"age_ms", quantiles(stats.age)},
            {"first_frame_ms", quantiles(stats.firstFrame)},
            {"errors", std::move(errors)}};
}

json::object serverJson(const Outcome& outcome) {
    const TreeUse& most = outcome.most;
    const double own = outcome.after.rootCpuS - outcome.before.rootCpuS;
    const double children = outcome.after.childrenCpuS - outcome.before.childrenCpuS;
    return {{"cpu_s", own},
            {"workers_cpu_s", children},
            {"resident_bytes", most.rootBytes},
            {"resident_bytes_with_workers", most.treeBytes},
            {"processes", most.processes},
            {"threads", most.rootThreads},
            {"descriptors", most.rootDescriptors}};
}

}  // namespace

std::vector<std::string> violations(const Outcome& outcome, const Thresholds& thresholds) {
    Histogram inputToFrame, age;
    std::uint64_t errors = 0;
    std::optional<double> slowest;
    for (const auto& [kind, stats] : outcome.kinds) {
        inputToFrame.merge(stats.inputToFrame);
        age.merge(stats.age);
        errors += errorsOf(stats);
        if (!stats.moves) continue;
        const double least = framesPerSecond(stats, outcome).least;
        slowest = std::min(slowest.value_or(least), least);
    }
    std::vector<std::string> all;
    const auto atMost = [&all](const char* what, double value, const std::optional<double>& limit) {
        if (limit && value > *limit)
            all.push_back(format("%s: %.4g, more than %.4g", what, value, *limit));
    };
    atMost("input to frame p50 ms", inputToFrame.quantileMs(0.50), thresholds.maxP50Ms);
    atMost("input to frame p95 ms", inputToFrame.quantileMs(0.95), thresholds.maxP95Ms);
    atMost("input to frame p99 ms", inputToFrame.quantileMs(0.99), thresholds.maxP99Ms);
    atMost("frame age p99 ms", age.quantileMs(0.99), thresholds.maxAgeP99Ms);
    atMost("errors", static_cast<double>(errors), thresholds.maxErrors);
    constexpr double kMb = 1e6;
    atMost("server MB", static_cast<double>(outcome.most.treeBytes) / kMb, thresholds.maxServerMb);
    // What was not seen at all keeps no limit.
    const bool wantsLatency = thresholds.maxP50Ms || thresholds.maxP95Ms || thresholds.maxP99Ms;
    if (wantsLatency && inputToFrame.count() == 0)
        all.emplace_back("input to frame: no frame answered an input");
    if (thresholds.maxAgeP99Ms && age.count() == 0)
        all.emplace_back("frame age: no frame showed a new input");
    if (thresholds.minFps && slowest.value_or(0) < *thresholds.minFps) {
        all.push_back(format("frames/s of the slowest client: %.4g, less than %.4g",
                             slowest.value_or(0), *thresholds.minFps));
    }
    return all;
}

std::string reportText(const LoadSettings& settings, const Outcome& outcome) {
    std::ostringstream text;
    text << format("%s:%u, %u views, %g inputs/s, %u x %u, measured %.1f s%s\n\n",
                   settings.url.host.c_str(), unsigned{settings.url.port}, outcome.views,
                   settings.inputsPerSecond, settings.width, settings.height, outcome.seconds,
                   outcome.interrupted ? " (interrupted)" : "");
    text << "                         frames/s a client   input to frame, ms            age, ms\n"
            "kind             clients  slowest fastest     p50    p95    p99    max    p50    p99"
            "  overtaken    MB/s  errors\n";
    for (const auto& [kind, stats] : outcome.kinds) {
        const Slowest fps = framesPerSecond(stats, outcome);
        text << format(
            "%-16s %7u  %7.1f %7.1f  %6.0f %6.0f %6.0f %6.0f %6.0f %6.0f  %9llu %7.2f  %6llu\n",
            kind.c_str(), stats.clients, fps.least, fps.most, stats.inputToFrame.quantileMs(0.50),
            stats.inputToFrame.quantileMs(0.95), stats.inputToFrame.quantileMs(0.99),
            stats.inputToFrame.maxMs(), stats.age.quantileMs(0.50), stats.age.quantileMs(0.99),
            static_cast<unsigned long long>(stats.overtaken),
            perSecond(static_cast<double>(stats.bytes) / 1e6, outcome),
            static_cast<unsigned long long>(errorsOf(stats)));
    }
    for (const auto& [kind, stats] : outcome.kinds) {
        text << format(
            "\n%s: %llu connects (%llu failed, %llu lost), first frame after %.0f ms (p50), %.0f "
            "ms (max)",
            kind.c_str(), static_cast<unsigned long long>(stats.connects),
            static_cast<unsigned long long>(stats.failedConnects),
            static_cast<unsigned long long>(stats.lostConnections),
            stats.firstFrame.quantileMs(0.5), stats.firstFrame.maxMs());
        for (const auto& [what, count] : stats.errors) {
            text << "\n  " << count << " x " << what;
        }
    }
    text << '\n';
    if (outcome.serverMeasured) {
        const TreeUse& most = outcome.most;
        text << format(
            "\nserver: %.2f cores, its workers %.2f; %.0f MB resident, %.0f with workers; %u "
            "threads, %u descriptors\n",
            perSecond(outcome.after.rootCpuS - outcome.before.rootCpuS, outcome),
            perSecond(outcome.after.childrenCpuS - outcome.before.childrenCpuS, outcome),
            static_cast<double>(most.rootBytes) / 1e6, static_cast<double>(most.treeBytes) / 1e6,
            most.rootThreads, most.rootDescriptors);
    }
    return text.str();
}

json::object reportJson(const LoadSettings& settings, const Outcome& outcome,
                        const std::vector<std::string>& violated) {
    json::object kinds;
    for (const auto& [kind, stats] : outcome.kinds) kinds[kind] = kindJson(stats, outcome);
    json::object report{{"host", settings.url.host},
                        {"port", settings.url.port},
                        {"views", outcome.views},
                        {"inputs_per_s", settings.inputsPerSecond},
                        {"size", json::array{settings.width, settings.height}},
                        {"seconds", outcome.seconds},
                        {"interrupted", outcome.interrupted},
                        {"kinds", std::move(kinds)},
                        {"violations", json::array(violated.begin(), violated.end())}};
    if (outcome.serverMeasured) report["server"] = serverJson(outcome);
    return report;
}

}  // namespace volcast::load
