// What messages cost: robots that stand and talk, beside the same ones that are silent.
#include <cstdio>
#include <memory>
#include <string>

#include "bench/timing.h"
#include "simulation/small_world.h"

namespace mrose::bench {
namespace {

/// Says 32 bytes to all at each control instant, or nothing, and hears.
class Speaker final : public Controller {
public:
    explicit Speaker(bool talks) : talks_(talks) {}
    void decide(const Observation& observation, std::span<std::byte>, Decision& decision) const override {
        if (talks_) decision.messages.push_back(RadioMessage::of(std::array<double, 4>{toSeconds(observation.time)}));
    }

private:
    bool talks_;
};

/// 2.5 m apart in a square; teams of `teamOf` neighbours by their numbers, 0: one team.
Scenario crowd(int robots, bool talks, const Radio& radio, int teamOf) {
    SmallWorld world;
    const auto speaker = std::make_shared<const Speaker>(talks);
    const auto model = ideal();
    const RobotType type = discRobot();
    int side = 1;
    while (side * side < robots) ++side;
    for (int i = 0; i < robots; ++i) {
        world.robot(type, {2.5 * (i % side), 2.5 * (i / side), 0}, speaker, model, i % 5);
        if (teamOf > 0) world.parts().scene.robots.back().team = std::to_string(i / teamOf);
    }
    world.parts().scene.radio = radio;
    return world.scenario();
}

struct Cost {
    double nanoseconds = 0;  ///< per robot and tick
    double received = 0;     ///< messages by a robot at an instant
};

Cost costOf(const Scenario& scenario, bool traced) {
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    for (int k = 0; k < 60; ++k) step(scenario, state, buffers);
    constexpr int ticks = 100;
    std::vector<double> times;
    for (int round = 0; round < 5; ++round)
        times.push_back(secondsOf([&] {
            for (int k = 0; k < ticks; ++k) step(scenario, state, buffers, {}, traced ? &trace : nullptr);
        }));
    double received = 0, instants = 0;
    for (int k = 0; k < 5; ++k) {
        step(scenario, state, buffers, {}, &trace);
        for (const StepTrace::Robot& robot : trace.robots) {
            if (!robot.decided) continue;
            ++instants;
            received += static_cast<double>(robot.observation.messages().size());
        }
    }
    return {1e9 * median(times) / ticks / static_cast<double>(state.robots.size()), received / instants};
}

void line(const std::string& name, int robots, bool talks, const Radio& radio = {}, int teamOf = 0,
          bool traced = false) {
    const Cost cost = costOf(crowd(robots, talks, radio, teamOf), traced);
    std::printf("  %-52s %9.1f ns per robot and tick, %6.1f messages an instant\n", name.c_str(), cost.nanoseconds,
                cost.received);
}

}  // namespace
}  // namespace mrose::bench

int main() {
    using namespace mrose;
    using namespace mrose::bench;
    constexpr Nanoseconds ms = 1'000'000;
    for (const int robots : {8, 1000}) {
        std::printf("%d robots, a control period of 5 ticks\n", robots);
        line("silent", robots, false);
        line("silent, with a radio", robots, false, {.latency = 50 * ms, .jitter = 50 * ms, .loss = 0.1, .range = 5});
        line("all to all", robots, true);
        line("latency 200 ms, jitter 100 ms, loss", robots, true,
             {.latency = 200 * ms, .jitter = 100 * ms, .loss = 0.1});
        line("all to all, traced", robots, true, {}, 0, true);
        line("silent, traced", robots, false, {}, 0, true);
        if (robots == 8) continue;
        line("range 5 m", robots, true, {.range = 5});
        line("range 5 m, latency 200 ms, jitter 100 ms, loss", robots, true,
             {.latency = 200 * ms, .jitter = 100 * ms, .loss = 0.1, .range = 5});
        line("range 5 m, traced", robots, true, {.range = 5}, 0, true);
        line("teams of 10", robots, true, {}, 10);
        line("teams of 10, latency 200 ms, jitter 100 ms, loss", robots, true,
             {.latency = 200 * ms, .jitter = 100 * ms, .loss = 0.1}, 10);
    }
    return 0;
}
