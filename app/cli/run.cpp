#include "experiment/run.h"

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
    bool overwrite = false, endOnFault = false, checkRewind = false;
};

/// Keeps a run at a speed, writes its recording and shows how far it is.
class Conductor {
public:
    Conductor(const RunCommandFlags& flags, const CommonFlags& common, const Scenario& scenario, std::int64_t ticks)
        : flags_(flags), line_(common.quiet), tick_(toSeconds(scenario.scene().tickLength)), ticks_(ticks) {}

    Expected<void> record(const OpenScenario& open, const WorldState& initial) {
        RecordingWriter::Options options;
        options.overwrite = flags_.overwrite;
        auto writer = RecordingWriter::create(flags_.record, *open.scenario, initial,
                                              {open.loaded.name, open.loaded.texts}, commandLine(), options);
        if (!writer) return tl::unexpected(writer.error());
        writer_.emplace(std::move(*writer));
        return {};
    }

    /// False: the run ends here.
    bool after(const WorldState& state, const StepTrace& trace) {
        if (writer_) record(state, trace);
        keepPace(state.tick);
        if (const auto now = Clock::now(); now >= nextFlush_) {
            nextFlush_ = now + std::chrono::seconds(1);
            flush();
        }
        if (Clock::now() >= nextShown_) show(state.tick);
        return !wasInterrupted();
    }

    Expected<void> close(const WorldState& last) {
        if (!writer_) return {};
        writer_->keep(last);
        return writer_->close();
    }
    void flush() {
        if (writer_) writer_->flush();
    }
    double wallSeconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

    /// False: what is recorded ends before the run does, as was said when that happened.
    bool recording() const { return !lost_; }

private:
    void record(const WorldState& state, const StepTrace& trace) {
        writer_->add(state, trace);
        if (writer_->state() || lost_) return;
        lost_ = true;
        Error why = writer_->state().error();
        why.cause += "; the run goes on, and its recording ends here";
        report(why);
    }

    void keepPace(std::int64_t tick) {
        if (flags_.speed <= 0) return;
        const double due = static_cast<double>(tick) * tick_ / flags_.speed;
        std::this_thread::sleep_until(began_ +
                                      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due)));
    }

    void show(std::int64_t tick) {
        nextShown_ = Clock::now() + (line_.terminal() ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
        const double simulated = static_cast<double>(tick) * tick_;
        char text[160];
        std::snprintf(text, sizeof text, "%.1f of %.1f s, %.0f x real time", simulated,
                      static_cast<double>(ticks_) * tick_, simulated / wallSeconds());
        line_.show(text);
    }

    const RunCommandFlags& flags_;
    ProgressLine line_;
    double tick_;
    std::int64_t ticks_;
    std::optional<RecordingWriter> writer_;
    bool lost_ = false;
    Clock::time_point began_ = Clock::now(), nextShown_ = began_ + std::chrono::seconds(1), nextFlush_ = nextShown_;
};

void print(const Scenario& scenario, const RunCommandFlags& flags, const CommonFlags& common, const RunResult& result,
           double wall) {
    const double simulated = toSeconds(result.state.tick * scenario.scene().tickLength);
    const std::string hash = hexadecimal(hashOf(result.state).world);
    if (common.json) {
        nlohmann::json json = statisticsJson(scenario, result.statistics);
        json["scenario"] = scenario.parts().name;
        json["seed"] = result.state.seed;
        json["end"] = name(result.end);
        json["time_s"] = simulated;
        json["world_hash"] = hash;
        if (!flags.record.empty()) json["recording"] = flags.record;
        return void(std::puts(json.dump(2).c_str()));
    }
    const char* const why = result.end == RunEnd::condition ? ", ended by the condition"
                            : result.end == RunEnd::fault   ? ", ended by a fault"
                            : result.end == RunEnd::rewind  ? ", ended because it cannot be taken back"
                            : result.end == RunEnd::stopped ? ", interrupted"
                                                            : "";
    std::printf("%s, seed %llu: %.2f s%s; state %s\n", scenario.parts().name.c_str(),
                static_cast<unsigned long long>(result.state.seed), simulated, why, hash.c_str());
    std::fputs(statisticsText(scenario, result.statistics).c_str(), stdout);
    if (!common.quiet) std::printf("%.0f x real time\n", simulated / wall);
    if (!flags.record.empty()) std::printf("recorded in %s\n", flags.record.c_str());
}

/// What --check-rewind found in the tick that led to `tick`.
Error hiddenError(const Scenario& scenario, const RewindDifference& hidden, std::int64_t tick) {
    const std::string who = hidden.robot ? "robot \"" + scenario.scene().robots[*hidden.robot].name + "\": " : "";
    return {"", 0, 0, "", "tick " + std::to_string(tick - 1) + " cannot be taken back: " + who + hidden.what};
}

int runScenario(const RunCommandFlags& flags, const CommonFlags& common) {
    const auto open = openScenario(flags.run.scenario, flags.run.trial, flags.run.log, flags.run.plugins);
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
    Conductor conductor(flags, common, scenario, options.duration / scenario.scene().tickLength);
    if (!flags.record.empty())
        if (const auto opened = conductor.record(*open, initial); !opened) return report(opened.error());
    watchInterrupts();
    options.each = [&](const WorldState& state, const StepTrace& trace) { return conductor.after(state, trace); };
    beforePluginEndsProgram([&] { conductor.flush(); });
    const auto result = run(scenario, initial, options);
    beforePluginEndsProgram({});
    if (!result) return report(result.error());
    const auto closed = conductor.close(result->state);
    print(scenario, flags, common, *result, conductor.wallSeconds());
    if (!closed) return conductor.recording() ? report(closed.error()) : failure;
    for (const RewindDifference& hidden : result->hidden) report(hiddenError(scenario, hidden, result->state.tick));
    const bool failed = result->end == RunEnd::fault || result->end == RunEnd::rewind;
    return result->end == RunEnd::stopped ? interrupted : failed ? failure : success;
}

}  // namespace

Subcommand addRun(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<RunCommandFlags>();
    CLI::App* sub = addSubcommand(app, common, "run", "Run a scenario without a window",
                                  "  mrose run soccer.toml\n"
                                  "  mrose run soccer.toml --seed 7 --duration 600 --record game.mcap\n"
                                  "  mrose run soccer.toml --until 'distance(robot[1], ball) < 0.4'\n"
                                  "The same scenario, trial and seed give the same run to the last bit.");
    addRunFlags(*sub, flags->run);
    sub->add_option("--trial", flags->run.trial, "Start as this trial of a batch does; 0: as the scenario says")
        ->capture_default_str();
    sub->add_option("--speed", flags->speed, "Times real time; 0: as fast as it goes")
        ->check(numberRange(0.0, 1e6))
        ->capture_default_str();
    sub->add_option("--record", flags->record, "Write a recording (MCAP), which Foxglove opens, too");
    sub->add_flag("--overwrite", flags->overwrite, "Replace a recording that is there");
    sub->add_flag("--end-on-fault", flags->endOnFault, "End the run at the first fault of a controller or model");
    sub->add_flag("--check-rewind", flags->checkRewind,
                  "Take every tick twice, and end the run naming the controller that hides something from the state");
    sub->callback([sub, flags, &common] {
        if (sub->count("--seed") > 0) flags->run.seed = common.seed;
    });
    return {sub, [flags, &common] { return runScenario(*flags, common); }};
}

}  // namespace mrose::cli
