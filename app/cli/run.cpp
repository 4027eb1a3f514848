#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "io/format.h"
#include "plugin_watch.h"
#include "report/program_json.h"
#include "scenario_flags.h"
#include "workflow/run_scenario.h"
#include "world/state_hash.h"

namespace mrose::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// "1300", "0.52"
std::string factorText(double factor) {
    char text[40];
    std::snprintf(text, sizeof text, factor < 9.95 ? "%.2g" : "%.0f", factor);
    return text;
}

/// Keeps a run at a speed and its recording on the disk, and shows how far it is.
class Conductor {
public:
    /// `speed`: times real time; 0: as fast as it goes.
    Conductor(double speed, bool quiet) : speed_(speed), line_(quiet) {}
    ~Conductor() { beforePluginEndsProgram({}); }

    /// As the hooks of RunWatch of the same names.
    void opened(const OpenedScenario& opened) {
        reportNotes(opened.notes);
        tick_ = toSeconds(opened.scenario->scene().tickLength);
        watchInterrupts();
    }
    void begins(const WorldState& initial, std::int64_t ticks, const std::function<void()>& flush) {
        first_ = initial.tick;
        ticks_ = ticks;
        flush_ = flush;
        began_ = Clock::now();
        nextShown_ = nextFlushed_ = began_ + std::chrono::seconds(1);
        beforePluginEndsProgram(flush);
    }
    bool each(const WorldState& state) {
        keepPace(state.tick);
        const Clock::time_point now = Clock::now();
        if (now >= nextFlushed_) {
            nextFlushed_ = now + std::chrono::seconds(1);
            flush_();
        }
        if (now >= nextShown_) show(state.tick);
        return !wasInterrupted();
    }
    void lost(const Error& error) {
        line_.clear();
        report(error);
    }

    void clear() { line_.clear(); }
    double wallSeconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

private:
    void keepPace(std::int64_t tick) const {
        if (speed_ <= 0) return;
        const double due = static_cast<double>(tick - first_) * tick_ / speed_;
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

    double speed_;
    ProgressLine line_;
    double tick_ = 0;  ///< s
    std::int64_t first_ = 0, ticks_ = 0;
    std::function<void()> flush_;
    Clock::time_point began_, nextShown_, nextFlushed_;
};

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
        case RunEnd::noBranch:
            return ", in which it did not branch";
    }
    return "";
}

/// What happened, for people.
std::string statisticsText(const Scenario& scenario, const RunStatistics& statistics) {
    const Scene& scene = scenario.scene();
    std::string text;
    char line[200];
    for (std::size_t g = 0; g < statistics.goals.size(); ++g)
        text += (g == 0 ? "goals: " : ", ") + std::to_string(statistics.goals[g]) + " in " +
                scene.environment.goals[g].name;
    if (!text.empty()) text += '\n';
    text += "touches: " + std::to_string(statistics.touches);
    const bool kickers = std::any_of(scene.robots.begin(), scene.robots.end(), [&](const SceneRobot& robot) {
        return !scene.robotTypes[robot.type].manipulators.empty();
    });
    if (kickers)
        text += "; kicks: " + std::to_string(statistics.kicks) + ", " + std::to_string(statistics.hits) +
                " of them on a ball";
    text += '\n';
    TextTable table({"", "driven, m"});
    for (std::size_t i = 0; i < statistics.driven.size(); ++i) {
        std::snprintf(line, sizeof line, "%.2f", statistics.driven[i]);
        table.add({bodyName(scene, i), line});
    }
    text += table.text();
    const auto note = [&](const std::vector<std::optional<std::int64_t>>& ticks, const char* what) {
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            const double share = statistics.shareOf(ticks[i].value_or(0));
            if (share < RunStatistics::notableShare) continue;
            std::snprintf(line, sizeof line, ": in %.0f %% of the run ", 100 * share);
            text += "Note: " + bodyName(scene, i) + line + what + '\n';
        }
    };
    note(statistics.unfamiliar, "driven as its network has not learned");
    note(statistics.beyond, "its controller asked beyond what was learned");
    if (statistics.faults > 0) {
        std::snprintf(line, sizeof line, "faults: %lld, the first of ", static_cast<long long>(statistics.faults));
        text += line + statistics.firstFault + '\n';
    }
    return text;
}

/// As in the rows of an experiment: NaN without a sign.
std::string measuredText(double value) { return std::isnan(value) ? "nan" : plainNumberText(value); }

/// 0: of none.
std::uint32_t trialOf(const ScenarioRun& run, const RunRequest& request) {
    return run.opened.trial ? run.opened.trial->number : request.scenario.trial;
}

void print(const ScenarioRun& run, const RunRequest& request, double wall) {
    const RunResult& result = run.result;
    const Scenario& scenario = run.scenario();
    const double simulated = toSeconds(result.state.tick * scenario.scene().tickLength);
    const double taken = toSeconds(result.statistics.ticks * scenario.scene().tickLength);
    const auto& drawn = run.opened.trial;
    const std::uint32_t number = trialOf(run, request);
    std::string trial = number > 0 ? ", trial " + std::to_string(number) : "";
    if (drawn && !drawn->variant.empty()) trial += ", " + drawn->variant;
    std::printf("%s%s, seed %llu: %.2f s%s", scenario.parts().name.c_str(), trial.c_str(),
                static_cast<unsigned long long>(result.state.seed), simulated,
                endText(result.end, !request.until.empty()));
    if (wall > 0) std::printf(" (%s x real time)", factorText(taken / wall).c_str());
    std::printf("\n%s", statisticsText(scenario, result.statistics).c_str());
    if (!run.measured.empty()) {
        TextTable table({"", "measured"});
        for (const auto& [name, value] : run.measured) table.add({name, measuredText(value)});
        std::printf("%s", table.text().c_str());
    }
    if (request.checkRewind && result.end != RunEnd::rewind)
        std::printf("%lld ticks taken twice, each time with the same end\n",
                    static_cast<long long>(result.statistics.ticks));
    std::printf("state %s\n", hexadecimal(hashOf(result.state).world).c_str());
    if (run.recorded) std::printf("recorded in %s\n", request.recording.c_str());
}

int runRun(const RunRequest& request, double speed, const CommonFlags& common) {
    Conductor conductor(speed, common.quiet);
    RunWatch watch;
    watch.opened = [&](const OpenedScenario& opened) { conductor.opened(opened); };
    watch.begins = [&](const WorldState& initial, std::int64_t ticks, const std::function<void()>& flush) {
        conductor.begins(initial, ticks, flush);
    };
    watch.each = [&](const WorldState& state) { return conductor.each(state); };
    watch.lost = [&](const Error& error) { conductor.lost(error); };
    const auto run = runScenario(request, watch);
    conductor.clear();
    if (!run) return report(run.error());
    const RunResult& result = run->result;
    if (common.json)
        std::puts(runJson(run->scenario(), result,
                          {trialOf(*run, request), run->opened.trial ? run->opened.trial->variant : "",
                           request.checkRewind, run->recorded ? request.recording : "", run->measured})
                      .c_str());
    else
        print(*run, request, common.quiet ? 0 : conductor.wallSeconds());
    for (const std::string& hidden : hiddenText(run->scenario(), result)) report({"", 0, 0, "", hidden});
    const bool failed = run->lost || result.end == RunEnd::fault || result.end == RunEnd::rewind;
    if (result.end == RunEnd::stopped) return interruptedStatus();
    return failed ? failure : success;
}

}  // namespace

Subcommand addRun(CLI::App& app, CommonFlags& common) {
    struct Flags {
        RunRequest request;
        double speed = 0;
    };
    auto flags = std::make_shared<Flags>();
    RunRequest& request = flags->request;
    request.command = commandLine();
    CLI::App* sub = addSubcommand(app, common, "run", "Run a scenario without a window",
                                  "  mrose run soccer.toml\n"
                                  "  mrose run soccer.toml --seed 7 --duration 600 --record game.mcap\n"
                                  "  mrose run soccer.toml --until 'distance(robot[1], ball) < 0.4'\n"
                                  "The same scenario, trial and seed give the same run to the last bit.");
    addSeed(*sub, common);
    addOverwrite(*sub, common);
    addScenarioFlags(*sub, request.scenario, request.duration, request.until);
    sub->add_option("--trial", request.scenario.trial, "Start as this trial of a batch or an experiment does")
        ->check(someTrial())
        ->default_str("as the scenario says, the experiment's first");
    sub->add_option("--variant", request.scenario.variant, "Which variant of an experiment")->check(someName());
    sub->add_option("--speed", flags->speed, "Times real time; 0: as fast as it goes")
        ->check(numberRange(0.0, 1e6))
        ->capture_default_str();
    sub->add_option("--record", request.recording, "Write a recording (MCAP), which Foxglove opens, too")
        ->check(someName());
    sub->add_flag("--end-on-fault", request.endOnFault, "End the run at the first fault of a controller or model");
    sub->add_flag("--check-rewind", request.checkRewind,
                  "Take every tick twice, and end the run naming the controller that hides something from the state");
    sub->callback([sub, flags, &common] {
        if (sub->count("--seed") > 0) flags->request.seed = common.seed;
        flags->request.overwrite = common.overwrite;
    });
    return {sub, [flags, &common] { return runRun(flags->request, flags->speed, common); }};
}

}  // namespace mrose::cli
