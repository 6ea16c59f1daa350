// A table of frame ages over simulated links: no acks, one credit, full control. No clock is read:
// the same table comes out everywhere.
#include <array>
#include <cstdio>

#include "tests/support/link_model.h"

int main() {
    using namespace volcast::test;
    constexpr double kSeconds = 60, kSettledS = 20;
    std::printf("Seconds 20 to 60 of steering; pictures of 50 KB, 30 of them drawn in a second.\n");
    std::printf("%-9s %6s  %-11s %8s %8s %8s %9s  %s\n", "Mbit/s", "rtt ms", "control", "p50 ms",
                "p95 ms", "max ms", "frames/s", "at the end");
    for (const double megabits : {1.0, 10.0, 100.0}) {
        for (const double roundTripMs : {5.0, 50.0, 200.0}) {
            const Link link{.bytesPerS = megabits * 125e3, .roundTripS = roundTripMs / 1e3};
            struct Row {
                const char* name;
                Control control;
                bool video;
            };
            for (const Row& row : {Row{"no acks", Control::kNone, false},
                                   Row{"one credit", Control::kOneCredit, false},
                                   Row{"full, JPEG", Control::kFull, false},
                                   Row{"full, VP9", Control::kFull, true}}) {
                const LinkRun run =
                    runLink(link, row.control, kSeconds, 1.0 / 30, 0.004, row.video);
                const auto& last = run.shown.back().level;
                std::printf(
                    "%-9g %6g  %-11s %8.0f %8.0f %8.0f %9.1f  %s quality %d scale %g%s%s, "
                    "%zu steps\n",
                    megabits, roundTripMs, row.name, ageMs(run, 0.5, kSettledS),
                    ageMs(run, 0.95, kSettledS), ageMs(run, 1.0, kSettledS),
                    framesPerS(run, kSettledS, kSeconds), last.video ? "video" : "JPEG",
                    last.quality, last.scale, last.fullAccuracy ? "" : " fast",
                    last.framesPerS > 0 ? " slow" : "", run.steps.size());
            }
        }
    }
}
