// Speed of the world's step, as ratios to plain Box2D run beside it in the same minutes: absolute times do not hold
// from machine to machine. Both run at their default step: 50 Hz here, 60 Hz there.

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "bench/plain_box2d.h"
#include "bench/timing.h"
#include "motion/learned_model.h"
#include "simulation/step.h"
#include "support/places.h"
#include "support/scenes.h"

namespace mrose::bench {
namespace {

/// How often few robots touch is a matter of chance: their scenes are run from several starts, the peer's as well.
std::uint64_t startsOf(std::uint32_t robots) { return robots <= 100 ? 5 : 1; }

/// Runs of ours that go on from call to call.
struct OurRuns {
    explicit OurRuns(const FieldOptions& options) : scenario(fieldScenario(options)) {
        for (std::uint64_t seed = 1; seed <= startsOf(options.robots); ++seed)
            states.push_back(scenario.initialState(seed));
    }

    /// So many seconds, an equal share from each start.
    void run(double simulated) {
        const auto ticks = static_cast<std::int64_t>(simulated * 50 / static_cast<double>(states.size()) + 0.5);
        for (WorldState& state : states)
            for (std::int64_t i = 0; i < ticks; ++i) step(scenario, state, buffers);
    }

    Scenario scenario;
    std::vector<WorldState> states;
    StepBuffers buffers;
};

struct Line {
    std::string name;
    std::function<void(double)> run;  ///< simulates so many seconds
    std::vector<double> rtf = {};
};

/// Round by round all of them; simulated seconds per second, and the ratio to the first.
void compare(const std::string& title, std::vector<Line> lines, double simulated, std::uint32_t robots) {
    constexpr int rounds = 7;
    for (int round = 0; round < rounds; ++round)
        for (Line& line : lines) {
            line.run(simulated / 4);  // what the others left in the caches is not its fault
            line.rtf.push_back(simulated / secondsOf([&] { line.run(simulated); }));
        }
    std::printf("\n%s\n", title.c_str());
    for (const Line& line : lines) {
        std::vector<double> ratios;
        for (int round = 0; round < rounds; ++round) ratios.push_back(line.rtf[round] / lines[0].rtf[round]);
        const double rtf = median(line.rtf);
        std::printf("  %-46s %10.0f x real time", line.name.c_str(), rtf);
        if (&line != lines.data())
            std::printf("  %6.2f of the peer  %7.1f ns per robot and tick", median(ratios), 1e9 / (rtf * 50 * robots));
        std::printf("\n");
    }
}

Line peer(std::uint32_t robots, bool heavy) {
    auto worlds = std::make_shared<std::vector<PlainBox2d>>();
    for (std::uint64_t seed = 1; seed <= startsOf(robots); ++seed) worlds->emplace_back(robots, heavy, seed);
    return {"plain Box2D 2.4.1, 60 Hz", [worlds](double simulated) {
                const auto tenths = static_cast<int>(simulated * 10 / static_cast<double>(worlds->size()) + 0.5);
                for (PlainBox2d& world : *worlds)
                    for (int i = 0; i < tenths; ++i) world.run();
            }};
}

Line ours(const std::string& name, const FieldOptions& options) {
    auto runs = std::make_shared<OurRuns>(options);
    return {name, [runs](double simulated) { runs->run(simulated); }};
}

std::shared_ptr<const MotionModel> ourNetwork(MotionDraw draw) {
    const auto network = loadNetwork(sourceFolder() / "nets" / "create.net");
    if (!network) return nullptr;
    return std::make_shared<const LearnedModel>(std::make_shared<const LearnedMotion>(*network), "1", draw);
}

void compareScene(const std::string& title, std::uint32_t robots, bool heavy, double simulated) {
    FieldOptions options;
    options.robots = robots;
    options.heavy = heavy;
    std::vector<Line> lines{peer(robots, heavy), ours("paper's network, dead time, motion noise", options)};
    const auto seeing = [&](const std::string& name, const Perception& perception) {
        FieldOptions own = options;
        own.perception = perception;
        lines.push_back(ours(name, own));
    };
    if (robots <= 8) {
        seeing("with perception", noisyPerception());
        FieldOptions learned = options;
        learned.share = 0.1;  // a network is asked what its robot can do
        learned.motionNoise = false;
        if ((learned.model = ourNetwork(MotionDraw::mean)))
            lines.push_back(ours("with nets/create.net, at a tenth of the speeds", learned));
        if ((learned.model = ourNetwork(MotionDraw::noisy))) lines.push_back(ours("the same with its noise", learned));
    }
    if (!heavy) {
        seeing("with cameras of 5 m", cameraPerception(5));
        seeing("with cameras without limit", cameraPerception(0));
    }
    compare(title, std::move(lines), simulated, robots);
}

double worldsPerSecond(int threads, int worlds, double simulated) {
    FieldOptions options;
    const Scenario scenario = fieldScenario(options);
    tbb::task_arena arena(threads);
    const auto ticks = static_cast<std::int64_t>(simulated * 50);
    const double took = secondsOf([&] {
        arena.execute([&] {
            tbb::parallel_for(0, worlds, [&](int world) {
                StepBuffers buffers;
                WorldState state = scenario.initialState(static_cast<std::uint64_t>(world));
                for (std::int64_t i = 0; i < ticks; ++i) step(scenario, state, buffers);
            });
        });
    });
    return worlds * static_cast<double>(ticks) / took;
}

void batch() {
    std::vector<double> one, two, ratios;
    for (int round = 0; round < 3; ++round) {
        one.push_back(worldsPerSecond(1, 1000, 6));
        two.push_back(worldsPerSecond(2, 1000, 6));
        ratios.push_back(two.back() / one.back());
    }
    std::printf("\nBatch of 1000 worlds of S1 heavy\n  one thread %.0f, two threads %.0f world steps/s: %.2f times\n",
                median(one), median(two), median(ratios));
}

void stateSize() {
    const Scenario scenario = fieldScenario({});
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    for (int i = 0; i < 1000; ++i) step(scenario, state, buffers);
    const std::size_t bytes =
        sizeof state + state.robots.size() * sizeof state.robots[0] + state.objects.size() * sizeof state.objects[0] +
        state.contacts.size() * sizeof state.contacts[0] + state.commands.size() * sizeof state.commands[0] +
        state.memory.size() + state.past.size() * sizeof state.past[0];
    constexpr int copies = 100'000;
    WorldState copy;
    const double took = secondsOf([&] {
        for (int i = 0; i < copies; ++i) {
            state.tick = i;
            copy = state;
        }
    });
    const double fresh = secondsOf([&] {
        for (int i = 0; i < copies; ++i) {
            const WorldState anew = state;
            copy.tick += anew.tick;
        }
    });
    std::printf("\nState of 8 robots: %zu bytes; copied in %.2f us over an old copy, %.2f us anew\n", bytes,
                1e6 * took / copies, 1e6 * fresh / copies);
}

}  // namespace
}  // namespace mrose::bench

int main(int argc, char** argv) {
    using namespace mrose::bench;
    const std::string only = argc > 1 ? argv[1] : "";
    const auto wanted = [&](const char* name) { return only.empty() || only == name; };
    if (wanted("S1heavy")) compareScene("S1 heavy: 8 robots that collide", 8, true, 100);
    if (wanted("S1light")) compareScene("S1 light: 8 robots that hardly touch", 8, false, 200);
    if (wanted("S2light"))
        for (const std::uint32_t robots : {100U, 1000U, 10000U})
            compareScene("S2 light: " + std::to_string(robots) + " robots", robots, false, 2000.0 / robots);
    if (wanted("batch")) batch();
    if (wanted("state")) stateSize();
    return 0;
}
