#include "workflow/run_scenario.h"

#include "recording/recording_writer.h"
#include "workflow/outputs.h"

namespace mrose {
namespace {

/// Begins the recording.
Expected<RecordingWriter> recordingOf(const RunRequest& request, const OpenedScenario& opened,
                                      const WorldState& initial) {
    std::vector<std::string> read;
    for (const Value::File& file : opened.loaded.value.files()) read.push_back(file->name);
    for (const auto& [path, hash] : opened.plugins) read.push_back(path);
    if (auto other = checkNotRead(request.recording, read); !other) return tl::unexpected(other.error());
    RecordingWriter::Options options;
    options.overwrite = request.overwrite;
    return RecordingWriter::create(request.recording, *opened.scenario, initial,
                                   std::make_shared<const ScenarioValue>(opened.loaded.value), request.command,
                                   options);
}

/// A recording that may be lost while the run goes on.
class KeptRecording {
public:
    KeptRecording(std::optional<RecordingWriter> writer, const RunWatch& watch)
        : writer_(std::move(writer)), watch_(watch) {}

    void add(const WorldState& state, const StepTrace& trace) {
        if (!writer_) return;
        writer_->add(state, trace);
        if (writer_->state()) return;
        giveUp(writer_->state().error(), "; the run goes on, and its recording ends here");
        writer_.reset();
    }
    void flush() {
        if (writer_) writer_->flush();
    }
    /// `last`: the run's last state, where it has one.
    std::optional<Error> close(const WorldState* last) {
        if (writer_ && last != nullptr) writer_->keep(*last);
        if (writer_)
            if (const auto closed = writer_->close(); !closed) giveUp(closed.error(), "");
        writer_.reset();
        return lost_;
    }

private:
    void giveUp(Error error, const std::string& more) {
        error.cause += more;
        if (watch_.lost) watch_.lost(error);
        lost_ = std::move(error);
    }

    std::optional<RecordingWriter> writer_;
    const RunWatch& watch_;
    std::optional<Error> lost_;
};

/// A trial of an experiment under way, measured as for a row of its results.
class TrialUnderWay {
public:
    TrialUnderWay(const OpenedTrial& trial, const Scenario& scenario)
        : trial_(trial), scenario_(scenario), expressions_(*trial.experiment) {}

    /// How it is to be run; this must outlive the run.
    Expected<RunOptions> begin(const WorldState& initial) {
        const BranchPoint* const branch = trial_.branch.get();
        const std::vector<RobotInsight> none(initial.robots.size());
        if (branch != nullptr && !branch->isReached()) {
            const auto compiled =
                expressions_.of({.scenario = &scenario_, .state = &initial, .insights = none, .drawn = &trial_.drawn});
            if (!compiled) return tl::unexpected(compiled.error());
            return untilBranch(*(*compiled)->branch, *trial_.experiment, scenario_, trial_.drawn);
        }
        const Moment asked{.scenario = branch != nullptr ? branch->scenario.get() : &scenario_,
                           .state = branch != nullptr ? &branch->before.state : &initial,
                           .insights = none,
                           .drawn = &trial_.drawn};
        const auto compiled = expressions_.of(asked);
        if (!compiled) return tl::unexpected(compiled.error());
        measurement_.emplace(measurementOf(*trial_.experiment, **compiled, scenario_));
        if (const auto begun = measurement_->begin(asked); !begun) return tl::unexpected(begun.error());
        return measuring(*measurement_, **compiled, *trial_.experiment, scenario_, trial_.drawn);
    }
    /// None of a trial that does not branch.
    std::vector<MeasuredValue> values() const {
        return measurement_ ? measuredValues(*trial_.experiment, *measurement_) : std::vector<MeasuredValue>();
    }
    /// How it has ended, as its row says.
    RunEnd end(RunEnd end, Nanoseconds duration) const {
        const bool waited = !measurement_ && duration >= trial_.experiment->branchWithin;
        return end == RunEnd::duration && waited ? RunEnd::noBranch : end;
    }

private:
    const OpenedTrial& trial_;
    const Scenario& scenario_;
    TrialExpressions expressions_;
    std::optional<TrialMeasurement> measurement_;
};

}  // namespace

Expected<std::optional<Condition>> openCondition(const std::string& text, const Scenario& scenario) {
    if (text.empty()) return std::optional<Condition>{};
    auto compiled = compileCondition(text, scenario, "--until");
    if (!compiled) return tl::unexpected(compiled.error());
    return std::optional<Condition>(std::move(*compiled));
}

Expected<ScenarioRun> runScenario(const RunRequest& request, const RunWatch& watch) {
    auto opened = openScenario(request.scenario);
    if (!opened) return tl::unexpected(opened.error());
    if (watch.opened) watch.opened(*opened);
    const Scenario& scenario = *opened->scenario;
    auto until = openCondition(request.until, scenario);
    if (!until) return tl::unexpected(until.error());
    const WorldState initial = opened->initialState(request.seed);
    RunOptions options;
    std::optional<TrialUnderWay> trial;
    if (opened->trial) {
        auto measuring = trial.emplace(*opened->trial, scenario).begin(initial);
        if (!measuring) return tl::unexpected(measuring.error());
        options = std::move(*measuring);
    }
    options.duration = request.duration ? fromSeconds(*request.duration) : scenario.parts().duration;
    options.until = *until ? &**until : nullptr;
    options.endOnFault = request.endOnFault || trial;
    options.checkRewind = request.checkRewind;
    options.countsBeyond = true;
    options.traceUnread = !request.recording.empty();
    std::optional<RecordingWriter> writer;
    if (!request.recording.empty()) {
        auto begun = recordingOf(request, *opened, initial);
        if (!begun) return tl::unexpected(begun.error());
        writer.emplace(std::move(*begun));
    }
    KeptRecording recording(std::move(writer), watch);
    if (watch.begins)
        watch.begins(initial, options.duration / scenario.scene().tickLength, [&recording] { recording.flush(); });
    if (!request.recording.empty())
        options.each = [&](const WorldState& state, const StepTrace& trace) {
            recording.add(state, trace);
            return true;
        };
    options.goesOn = watch.each;
    auto result = run(scenario, initial, options);
    auto lost = recording.close(result ? &result->state : nullptr);
    if (!result) return tl::unexpected(result.error());
    if (trial) result->end = trial->end(result->end, options.duration);
    const bool recorded = !request.recording.empty() && !lost;
    auto measured = trial ? trial->values() : std::vector<MeasuredValue>();
    return ScenarioRun{std::move(*opened), std::move(*result), std::move(measured), recorded, std::move(lost)};
}

std::vector<std::string> hiddenText(const Scenario& scenario, const RunResult& result) {
    std::vector<std::string> sentences;
    for (const RewindDifference& hidden : result.hidden) {
        const std::string who =
            hidden.robot ? "robot \"" + scenario.scene().robots[*hidden.robot].name + "\": " : std::string();
        sentences.push_back("tick " + std::to_string(result.state.tick - 1) + " cannot be taken back: " + who +
                            hidden.what);
    }
    return sentences;
}

}  // namespace mrose
