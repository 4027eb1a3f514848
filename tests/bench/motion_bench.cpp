// Time of a learned motion model for one robot, alone and in a batch: reading the command history, the network, the
// step, and one run of its noise. Beside it, as the peer of the ratio, kinematics with dead time and lag on the same
// histories.
#include <algorithm>
#include <cstring>

#include <benchmark/benchmark.h>

#include "motion/kinematic.h"
#include "motion/learned_model.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr std::size_t robots = 1024;

/// Robots that are sent a new command every 100 ms, as a control program does, but not in step with each other: at the
/// instant of the prediction the newest commands are 0 to 100 ms old.
struct Traffic {
    std::vector<CommandHistory> histories{robots};
    std::size_t remembered;  ///< bytes of a robot
    std::vector<std::uint64_t> memories;
    std::vector<MotionInput> inputs;
    std::vector<MotionStep> steps{robots};

    explicit Traffic(const MotionModel& model)
        : remembered(std::max(model.memorySize(), sizeof(LearnedMotion::Memory))),
          memories(robots * remembered / sizeof(std::uint64_t)) {
        const std::span bytes = std::as_writable_bytes(std::span(memories));
        for (std::uint32_t r = 0; r < robots; ++r) {
            const Nanoseconds phase = 97'000 * r;
            for (int i = 0; i < 30; ++i)
                histories[r].issue(phase + i * 100'000'000LL,
                                   {0.1 * uniformNoise({1, i, r, 0}), 0.4 * normalNoise({1, i, r, 1})});
            const LearnedMotion::Memory begun{{0.05, 0.1}, 1};
            std::memcpy(&bytes[r * remembered], &begun, sizeof begun);
            inputs.push_back({&histories[r], 3'000'000'000LL, {0.05, 0.1}, bytes.subspan(r * remembered, remembered)});
            inputs.back().noise = NoiseKey{1, 0, r, 0};
        }
    }
};

void run(benchmark::State& state, const MotionModel& model) {
    Traffic traffic(model);
    const auto batch = static_cast<std::size_t>(state.range(0));
    std::size_t at = 0;
    std::int64_t tick = 0;
    for (auto _ : state) {
        for (MotionInput& input : std::span(traffic.inputs).subspan(at, batch)) input.noise->tick = tick;
        ++tick;
        model.predict(std::span(traffic.inputs).subspan(at, batch), std::span(traffic.steps).subspan(at, batch));
        benchmark::DoNotOptimize(traffic.steps.data());
        at = (at + batch) % robots;
    }
    state.counters["robot"] = benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(batch),
                                                 benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void network(benchmark::State& state, const char* file, MotionDraw draw = MotionDraw::mean) {
    const auto loaded = loadNetwork(std::string(MROSE_SOURCE_DIR "/nets/") + file);
    if (!loaded) return state.SkipWithError(loaded.error().message().c_str());
    run(state, LearnedModel(std::make_shared<const LearnedMotion>(*loaded), "1", draw));
}

void kinematics(benchmark::State& state) {
    KinematicParameters parameters;
    parameters.v = {0.16, 0.1, 0.9};
    parameters.w = {0.1, 0.14, 0.95};
    run(state, KinematicModel(parameters));
}

BENCHMARK_CAPTURE(network, history_create, "create.net")->Arg(1)->Arg(robots);
BENCHMARK_CAPTURE(network, history_create_sampled, "create.net", MotionDraw::noisy)->Arg(1)->Arg(robots);
BENCHMARK_CAPTURE(network, papers_create, "create_paper.net")->Arg(1)->Arg(robots);
BENCHMARK_CAPTURE(network, state_pioneer, "pioneer.net")->Arg(1)->Arg(robots);
BENCHMARK(kinematics)->Arg(1)->Arg(robots);

}  // namespace
}  // namespace mrose

BENCHMARK_MAIN();
