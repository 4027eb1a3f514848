// How fast any tick of an hour is shown again, and what an hour takes in memory: eight robots with built-in
// controllers, the soccer scenario as it ships. Prints the worst of many seeks; the issue is the longest wait, not the
// mean.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include <sys/resource.h>

#include "session/session.h"
#include "workflow/open_run.h"

namespace mrose::gui {
namespace {

double seconds(std::chrono::steady_clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

double residentMegabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

int bench(double minutes) {
    using Clock = std::chrono::steady_clock;
    const auto run = openRun({.file = "soccer.toml"});
    if (!run) return std::fprintf(stderr, "%s\n", run.error().message().c_str()), 1;
    const double before = residentMegabytes();
    TimeTravel travel(*run);
    const auto ticks = static_cast<std::int64_t>(minutes * 60 * 50);
    const auto begin = Clock::now();
    while (travel.tick() < ticks)
        if (auto done = travel.forward(); !done) return std::fprintf(stderr, "%s\n", done.error().message().c_str()), 1;
    const double took = seconds(Clock::now() - begin);
    std::printf("%.0f min played in %.1f s: %.0f x real time, %.1f us a tick\n", minutes, took, minutes * 60 / took,
                1e6 * took / static_cast<double>(ticks));
    std::printf("memory: %.0f MB more than before, of which timelines %.0f MB\n", residentMegabytes() - before,
                static_cast<double>(travel.branches().memory()) / (1 << 20));

    std::mt19937 random(1);
    std::vector<double> seeks, back, frames;
    for (int i = 0; i < 500; ++i) {
        const auto tick = static_cast<std::int64_t>(random() % static_cast<unsigned>(ticks));
        auto from = Clock::now();
        if (auto done = travel.seek(tick); !done) return 1;
        seeks.push_back(seconds(Clock::now() - from));
        from = Clock::now();
        if (auto done = travel.seek(tick - 1); !done) return 1;
        back.push_back(seconds(Clock::now() - from));
        from = Clock::now();
        const FieldFrame frame = frameOf(travel);
        frames.push_back(seconds(Clock::now() - from));
    }
    const auto tell = [](const char* what, std::vector<double>& times) {
        std::sort(times.begin(), times.end());
        std::printf("%-28s median %6.2f ms   worst of %zu %6.2f ms\n", what, 1e3 * times[times.size() / 2],
                    times.size(), 1e3 * times.back());
    };
    tell("any tick", seeks);
    tell("one tick back", back);
    tell("what a frame shows", frames);
    return 0;
}

}  // namespace
}  // namespace mrose::gui

int main(int argc, char** argv) { return mrose::gui::bench(argc > 1 ? std::atof(argv[1]) : 60); }
