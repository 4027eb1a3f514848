// "When did this last hold?", over an hour of eight robots in which it never did: the longest that such a question
// takes, of the soccer scenario as it ships and of robots that collide all the time. Beside it the hour itself, as it
// is simulated, and the next question of the same kind, which finds all known.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "bench/timing.h"
#include "debug/breakpoints.h"
#include "support/scenes.h"
#include "workflow/open_run.h"

namespace mrose::gui {
namespace {

Breakpoint waitingFor(const char* text) {
    Breakpoint breakpoint;
    breakpoint.text = text;
    return breakpoint;
}

int bench(const char* name, const OpenedRun& run, std::int64_t ticks) {
    TimeTravel travel(run);
    const std::clock_t begin = std::clock();
    const double played = bench::secondsOf([&] {
        while (travel.tick() < ticks)
            if (!travel.forward()) return;
    });
    std::printf("%s: %.0f min, simulated in %.2f s with %.2f s of one core's time\n", name,
                toSeconds(travel.setup().scene().timeOf(ticks)) / 60, played,
                static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    const auto goOn = [](double) { return true; };
    for (const char* text : {"robot[2].speed > 50", "robot[3].touching and distance(robot[3], ball) > 1000",
                             "(function() for i = 1, #robot do if robot[i].x > 1000 then return true end end return "
                             "false end)()"}) {
        Breakpoints breakpoints;
        breakpoints.replace({waitingFor(text)});
        const std::clock_t before = std::clock();
        const double search = bench::secondsOf([&] { (void)breakpoints.last({true}, travel, travel.tick(), goOn); });
        const double cores = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
        const double again = bench::secondsOf([&] { (void)breakpoints.last({true}, travel, travel.tick(), goOn); });
        std::printf(
            "  looked through in %.2f s (2 s are wanted) with %.2f s of the cores' time, again in %.1f ms: %s\n",
            search, cores, 1e3 * again, text);
    }
    Breakpoints breakpoints;
    breakpoints.replace({waitingFor("robot[2].x > robot[3].x")});
    const double near = bench::secondsOf([&] { (void)breakpoints.last({true}, travel, travel.tick(), goOn); });
    std::printf("  one that held not long ago: %.1f ms\n", 1e3 * near);
    Breakpoints waiting;
    waiting.replace({waitingFor("robot[2].speed > 50"), waitingFor("contact robot"), waitingFor("kick")});
    const double playing = bench::secondsOf([&] {
        for (std::int64_t i = 0; i < ticks / 10; ++i) {
            waiting.leave(travel);
            if (!travel.forward()) return;
            (void)waiting.arrive(travel, [](double) { return true; });
        }
    });
    std::printf("  simulating with three breakpoints takes %.2f times as long as without\n", 10 * playing / played);
    return 0;
}

int benchAll(double minutes) {
    const auto run = openRun({.file = "soccer.toml"});
    if (!run) return std::fprintf(stderr, "%s\n", run.error().message().c_str()), 1;
    const auto ticks = [&](const OpenedRun& of) { return of.setup->scene().ticksOf(fromSeconds(60 * minutes)); };
    bench("soccer.toml", *run, ticks(*run));
    OpenedRun heavy;
    auto scenario = std::make_shared<const Scenario>(fieldScenario({}));
    heavy.start = scenario->initialState();
    heavy.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, scenario});
    bench("eight that collide", heavy, ticks(heavy));
    return 0;
}

}  // namespace
}  // namespace mrose::gui

int main(int argc, char** argv) { return mrose::gui::benchAll(argc > 1 ? std::atof(argv[1]) : 60); }
