// What recording and perception cost a run, as ratios to the same run without, and what an hour of recording is like.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/timing.h"
#include "recording/playback.h"
#include "recording/recording.h"
#include "recording/recording_writer.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "world/noise.h"

namespace mrose::bench {
namespace {

/// A run that goes on from call to call, recorded or not.
class Run {
public:
    explicit Run(const FieldOptions& options) : scenario_(fieldScenario(options)), state_(scenario_.initialState()) {}

    void recordIn(const std::filesystem::path& path) {
        auto writer = RecordingWriter::create(path, scenario_, state_);
        if (!writer) std::abort();
        writer_ = std::make_unique<RecordingWriter>(std::move(*writer));
    }
    void go(std::int64_t ticks) {
        for (std::int64_t i = 0; i < ticks; ++i) {
            step(scenario_, state_, buffers_, {}, writer_ ? &trace_ : nullptr);
            if (writer_) writer_->add(state_, trace_);
        }
    }
    void close() {
        if (!writer_->close()) std::abort();
    }
    const Scenario& scenario() const { return scenario_; }

private:
    Scenario scenario_;
    WorldState state_;
    StepBuffers buffers_;
    StepTrace trace_;
    std::unique_ptr<RecordingWriter> writer_;
};

FieldOptions field(bool heavy, bool perception) {
    FieldOptions options;
    options.heavy = heavy;
    if (perception) options.perception = noisyPerception();
    return options;
}

/// Both runs in turn, some seconds simulated each; times are those of `costly`.
void compare(benchmark::State& state, Run& plain, Run& costly) {
    constexpr std::int64_t ticks = 1000;
    plain.go(ticks);
    costly.go(ticks);
    std::vector<double> ratios, more;
    for (auto _ : state) {
        const double without = secondsOf([&] { plain.go(ticks); }), with = secondsOf([&] { costly.go(ticks); });
        ratios.push_back(with / without);
        more.push_back(1e6 * (with - without) / ticks);
        state.SetIterationTime(with / ticks);
    }
    state.counters["ratio"] = median(ratios);
    state.counters["more_us_a_tick"] = median(more);
}

/// Arguments: whether the scene is the heavy one; whether the robots perceive.
void recordingATick(benchmark::State& state) {
    const TemporaryFolder folder;
    const FieldOptions options = field(state.range(0) != 0, state.range(1) != 0);
    Run plain(options), recorded(options);
    recorded.recordIn(folder.path() / "run.mcap");
    compare(state, plain, recorded);
}

void perceivingATick(benchmark::State& state) {
    Run plain(field(state.range(0) != 0, false)), seeing(field(state.range(0) != 0, true));
    compare(state, plain, seeing);
}

/// An hour of 8 robots: the bounds are 30 MB and 20 ms to any tick. One iteration is one tick sought at random.
void seekingInAnHour(benchmark::State& state) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "hour.mcap";
    Run run(field(state.range(0) != 0, state.range(1) != 0));
    run.recordIn(path);
    run.go(3600 * 50);
    run.close();
    state.counters["MB"] = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
    Expected<Recording> recording = fail("", "not opened");
    state.counters["open_s"] = secondsOf([&] { recording = openRecording(path); });
    if (!recording || !recording->damage.empty()) return state.SkipWithError("the recording cannot be opened");
    const Timeline& timeline = recording->branches[0].timeline;
    Playback playback(run.scenario());
    double worst = 0;
    std::uint32_t asked = 0;
    for (auto _ : state) {
        const auto tick =
            static_cast<std::int64_t>(uniformNoise({1, 0, asked++, 0}) * static_cast<double>(timeline.last()));
        const auto seek = [&] {
            const auto reached = playback.reach(timeline, tick);
            if (!reached || !reached->worldSame || !reached->memoriesSame) std::abort();
        };
        // The less of two, since what else runs on the machine interrupts one.
        const double took = std::min(secondsOf(seek), secondsOf(seek));
        worst = std::max(worst, took);
        state.SetIterationTime(took);
    }
    state.counters["worst_ms"] = 1e3 * worst;
}

BENCHMARK(recordingATick)
    ->ArgNames({"heavy", "perception"})
    ->ArgsProduct({{1, 0}, {0, 1}})
    ->UseManualTime()
    ->Iterations(150)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(perceivingATick)
    ->ArgNames({"heavy"})
    ->Arg(1)
    ->Arg(0)
    ->UseManualTime()
    ->Iterations(150)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(seekingInAnHour)
    ->ArgNames({"heavy", "perception"})
    ->ArgsProduct({{1, 0}, {0, 1}})
    ->UseManualTime()
    ->Iterations(2000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mrose::bench

BENCHMARK_MAIN();
