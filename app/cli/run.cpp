#include "experiment/run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "recording/recording_writer.h"
#include "scenarios.h"
#include "world/state_hash.h"

namespace mrose::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct RunCommandFlags {
    RunFlags run;
    std::string record;
    double speed = 0;
    bool endOnFault = false, checkRewind = false;
};

/// "1300", "0.52"
std::string factorText(double factor) {
    char text[40];
    std::snprintf(text, sizeof text, factor < 9.95 ? "%.2g" : "%.0f", factor);
    return text;
}

/// Keeps a run at a speed, writes its recording and shows how far it is.
class Conductor {
public:
    /// `ticks` from tick `first` on.
    Conductor(const RunCommandFlags& flags, const CommonFlags& common, const Scenario& scenario, std::int64_t first,
              std::int64_t ticks)
        : flags_(flags),
          overwrite_(common.overwrite),
          line_(common.quiet),
          tick_(toSeconds(scenario.scene().tickLength)),
          first_(first),
          ticks_(ticks) {}

    Expected<void> record(const OpenScenario& open, const WorldState& initial) {
        std::vector<std::string> read;
        for (const Value::File& file : open.loaded.value.files()) read.push_back(file->name);
        for (const auto& [path, hash] : open.plugins) read.push_back(path);
        if (auto other = checkNotRead(flags_.record, read); !other) return other;
        RecordingWriter::Options options;
        options.overwrite = overwrite_;
        auto writer =
            RecordingWriter::create(flags_.record, *open.scenario, initial,
                                    std::make_shared<const ScenarioValue>(open.loaded.value), commandLine(), options);
        if (!writer) return tl::unexpected(writer.error());
        writer_.emplace(std::move(*writer));
        return {};
    }

    /// False: the run ends here.
    bool after(const WorldState& state, const StepTrace& trace) {
        if (writer_) {
            writer_->add(state, trace);
            if (!writer_->state()) giveUpRecording();
        }
        keepPace(state.tick);
        const Clock::time_point now = Clock::now();
        if (now >= nextFlushed_) {
            nextFlushed_ = now + std::chrono::seconds(1);
            flush();
        }
        if (now >= nextShown_) show(state.tick);
        return !wasInterrupted();
    }

    /// Ends the recording; `last` is the run's last state, where it has one. False: something has gone wrong with it,
    /// and that was said.
    bool close(const WorldState* last) {
        line_.clear();
        if (writer_) {
            if (last != nullptr) writer_->keep(*last);
            if (const auto closed = writer_->close(); !closed) sayLost(closed.error(), "");
            writer_.reset();
        }
        return !lost_;
    }
    void flush() {
        if (writer_) writer_->flush();
    }
    double wallSeconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

private:
    void giveUpRecording() {
        line_.clear();
        sayLost(writer_->state().error(), "; the run goes on, and its recording ends here");
        writer_.reset();
    }

    void sayLost(Error error, const std::string& more) {
        error.cause += more;
        report(error);
        lost_ = true;
    }

    void keepPace(std::int64_t tick) {
        if (flags_.speed <= 0) return;
        const double due = static_cast<double>(tick - first_) * tick_ / flags_.speed;
        const auto until = began_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due));
        // However slow it is, it can be interrupted.
        while (Clock::now() < until && !wasInterrupted())
            std::this_thread::sleep_until(std::min(until, Clock::now() + std::chrono::milliseconds(100)));
    }

    void show(std::int64_t tick) {
        nextShown_ = Clock::now() + (line_.terminal() ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
        const double simulated = static_cast<double>(tick - first_) * tick_;
        char text[160];
        std::snprintf(text, sizeof text, "%.1f of %.1f s, %s x real time", simulated,
                      static_cast<double>(ticks_) * tick_, factorText(simulated / wallSeconds()).c_str());
        line_.show(text);
    }

    const RunCommandFlags& flags_;
    bool overwrite_;
    ProgressLine line_;
    double tick_;
    std::int64_t first_, ticks_;
    std::optional<RecordingWriter> writer_;
    bool lost_ = false;  ///< the recording
    Clock::time_point began_ = Clock::now(), nextShown_ = began_ + std::chrono::seconds(1), nextFlushed_ = nextShown_;
};

void printJson(const Scenario& scenario, const RunCommandFlags& flags, const RunResult& result, bool recorded) {
    nlohmann::json json = statisticsJson(scenario, result.statistics);
    json["scenario"] = scenario.parts().name;
    json["trial"] = flags.run.trial;
    json["seed"] = result.state.seed;
    json["end"] = name(result.end);
    // divided, as in the rows of a batch: toSeconds() multiplies, and 60 s would be 60.00000000000001
    json["time_s"] = static_cast<double>(result.state.tick * scenario.scene().tickLength) / nanosecondsPerSecond;
    json["world_hash"] = hexadecimal(hashOf(result.state).world);
    if (flags.checkRewind && result.end != RunEnd::rewind) json["ticks_taken_twice"] = result.statistics.ticks;
    if (recorded) json["recording"] = flags.record;
    std::puts(json.dump(2).c_str());
}

const char* endText(RunEnd end, bool conditional) {
    switch (end) {
        case RunEnd::condition:
            return ", ended by the condition";
        case RunEnd::fault:
            return ", ended by a fault";
        case RunEnd::rewind:
            return ", ended because it cannot be taken back";
        case RunEnd::stopped:
            return ", interrupted";
        case RunEnd::duration:
            return conditional ? ", in which the condition was never met" : "";
    }
    return "";
}

void print(const Scenario& scenario, const RunCommandFlags& flags, const RunResult& result, bool recorded,
           double wall) {
    const double simulated = toSeconds(result.state.tick * scenario.scene().tickLength);
    const double taken = toSeconds(result.statistics.ticks * scenario.scene().tickLength);
    const std::string trial = flags.run.trial > 0 ? ", trial " + std::to_string(flags.run.trial) : "";
    std::printf("%s%s, seed %llu: %.2f s%s", scenario.parts().name.c_str(), trial.c_str(),
                static_cast<unsigned long long>(result.state.seed), simulated,
                endText(result.end, !flags.run.until.empty()));
    if (wall > 0) std::printf(" (%s x real time)", factorText(taken / wall).c_str());
    std::printf("\n%s", statisticsText(scenario, result.statistics).c_str());
    if (flags.checkRewind && result.end != RunEnd::rewind)
        std::printf("%lld ticks taken twice, each time with the same end\n",
                    static_cast<long long>(result.statistics.ticks));
    std::printf("state %s\n", hexadecimal(hashOf(result.state).world).c_str());
    if (recorded) std::printf("recorded in %s\n", flags.record.c_str());
}

/// What --check-rewind found in the tick that led to `tick`.
Error hiddenError(const Scenario& scenario, const RewindDifference& hidden, std::int64_t tick) {
    const std::string who = hidden.robot ? "robot \"" + scenario.scene().robots[*hidden.robot].name + "\": " : "";
    return {"", 0, 0, "", "tick " + std::to_string(tick - 1) + " cannot be taken back: " + who + hidden.what};
}

int runScenario(const RunCommandFlags& flags, const CommonFlags& common) {
    const auto open = openScenario(flags.run, flags.run.trial);
    if (!open) return report(open.error());
    const Scenario& scenario = *open->scenario;
    auto until = openCondition(flags.run.until, scenario);
    if (!until) return report(until.error());
    RunOptions options;
    options.duration = flags.run.duration ? fromSeconds(*flags.run.duration) : scenario.parts().duration;
    options.until = *until ? &**until : nullptr;
    options.endOnFault = flags.endOnFault;
    options.checkRewind = flags.checkRewind;
    const WorldState initial = scenario.initialState(flags.run.seed.value_or(scenario.parts().seed));
    Conductor conductor(flags, common, scenario, initial.tick, options.duration / scenario.scene().tickLength);
    watchInterrupts();
    if (!flags.record.empty())
        if (const auto opened = conductor.record(*open, initial); !opened) return report(opened.error());
    options.each = [&](const WorldState& state, const StepTrace& trace) { return conductor.after(state, trace); };
    beforePluginEndsProgram([&] { conductor.flush(); });
    const auto result = run(scenario, initial, options);
    beforePluginEndsProgram({});
    const bool kept = conductor.close(result ? &result->state : nullptr);
    if (!result) return report(result.error());
    const bool recorded = kept && !flags.record.empty();
    if (common.json)
        printJson(scenario, flags, *result, recorded);
    else
        print(scenario, flags, *result, recorded, common.quiet ? 0 : conductor.wallSeconds());
    for (const RewindDifference& hidden : result->hidden) report(hiddenError(scenario, hidden, result->state.tick));
    const bool failed = !kept || result->end == RunEnd::fault || result->end == RunEnd::rewind;
    if (result->end == RunEnd::stopped) return interruptedStatus();
    return failed ? failure : success;
}

}  // namespace

Subcommand addRun(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<RunCommandFlags>();
    CLI::App* sub = addSubcommand(app, common, "run", "Run a scenario without a window",
                                  "  mrose run soccer.toml\n"
                                  "  mrose run soccer.toml --seed 7 --duration 600 --record game.mcap\n"
                                  "  mrose run soccer.toml --until 'distance(robot[1], ball) < 0.4'\n"
                                  "The same scenario, trial and seed give the same run to the last bit.");
    addSeed(*sub, common);
    addOverwrite(*sub, common);
    addRunFlags(*sub, flags->run);
    sub->add_option("--trial", flags->run.trial, "Start as this trial of a batch does; 0: as the scenario says")
        ->check(someTrial())
        ->capture_default_str();
    sub->add_option("--speed", flags->speed, "Times real time; 0: as fast as it goes")
        ->check(numberRange(0.0, 1e6))
        ->capture_default_str();
    sub->add_option("--record", flags->record, "Write a recording (MCAP), which Foxglove opens, too")
        ->check(someName());
    sub->add_flag("--end-on-fault", flags->endOnFault, "End the run at the first fault of a controller or model");
    sub->add_flag("--check-rewind", flags->checkRewind,
                  "Take every tick twice, and end the run naming the controller that hides something from the state");
    sub->callback([sub, flags, &common] {
        if (sub->count("--seed") > 0) flags->run.seed = common.seed;
    });
    return {sub, [flags, &common] { return runScenario(*flags, common); }};
}

}  // namespace mrose::cli
