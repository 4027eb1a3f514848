#include "reality/shown_rollout.h"

#include <algorithm>
#include <utility>

#include "files/window_files.h"
#include "frame/status_line.h"

namespace mrose::gui {

ShownRollout::ShownRollout(const WindowFrame& frame, FieldView& field, WindowFiles& files, const Parts& parts)
    : frame_(frame),
      files_(files),
      rollouts_(parts.rollouts),
      models_(parts.models),
      causes_(parts.causes),
      searcher_(parts.searcher),
      opener_(parts.opener),
      view_(frame.session, field, parts.rollouts) {
    connect(&frame.session, &Session::shown, this, &ShownRollout::followShown);
    connect(&models_, &LaidModels::laid, this, &ShownRollout::layReality);
    connect(&causes_, &CauseFinder::laid, this, &ShownRollout::layReality);
}

void ShownRollout::takeFollowed(BranchSetupPointer run, std::shared_ptr<const Reality> reality) {
    coming_ = Coming{std::move(run), {}, {}, std::move(reality)};
    if (frame_.session.current()) followShown();
}

void ShownRollout::takeReopened(std::size_t rollout, const OpenedRun& run) {
    rollouts_.setShown(rollout);
    compared_.reset();
    reloaded_ = run.setup;
    reality_ = run.reality;
}

void ShownRollout::forget() {
    coming_.reset();
    reality_ = nullptr;
    if (rollouts_.log()) return;
    view_.forget();
    run_ = 0;
}

void ShownRollout::setRobot(std::optional<std::size_t> robot) {
    // The selection goes and comes back with the run. Who selects nothing goes on asking about the same robot.
    if (!robot || robot == rollouts_.robotSet() || coming_) return;
    const auto before = rollouts_.robot();
    rollouts_.setRobot(robot);
    if (rollouts_.robot() != before) {
        causes_.find();
        emit divergencesChanged();
    }
    emit changed();
}

/// What the models make of the shown rollout, and why it leaves the real one.
void ShownRollout::look() {
    causes_.forget();
    models_.drive();
    if (!rollouts_.shown()) return;
    layReality();
    reportDivergences();
    causes_.find();
}

/// What really happened, with the rollouts of the models that are shown and of a cause.
void ShownRollout::layReality() {
    if (!reality_ || !rollouts_.shown()) return;
    auto laid = std::make_shared<Reality>(*reality_);
    laid->models = models_.drivenRollouts();
    if (auto rerun = causes_.shownRerun()) laid->models.push_back(std::move(*rerun));
    frame_.session.setReality(run_, std::move(laid));
}

void ShownRollout::reportDivergences() {
    emit divergencesChanged();
    if (!rollouts_.log()) return frame_.session.changeBreakpoints([](Breakpoints& all) { all.setDivergence({}); });
    if (!rollouts_.shown() || frame_.session.current() == nullptr) return;
    LeavingRobots leaving = leavingRobots(rollouts_.world(), rollouts_.rowsOf(*rollouts_.shown()));
    leaving.reality = reality_;
    leaving.compared = compared_;
    frame_.session.changeBreakpoints([leaving, met = searcher_.hitsElsewhere(*rollouts_.shown())](Breakpoints& all) {
        all.setDivergence({leavesReality(leaving), whoLeaves(leaving)});
        all.setHitsInOtherRuns(met);
    });
}

bool ShownRollout::goToDivergence() {
    if (!rollouts_.shown() || frame_.session.current() == nullptr) return false;
    if (const RolloutRow* const leaves = rollouts_.leavingRow()) {
        const Nanoseconds time = leaves->divergence->time;
        view_.select(leaves->robot);
        setRobot(leaves->robot);
        view_.showNearer();
        frame_.session.seek(frame_.session.current()->frame->scene().ticksOf(time), false);
        return true;
    }
    const auto next = rollouts_.nextLeft();
    if (!next) return false;
    frame_.status.say(
        tr("Nothing leaves the %1 trajectory in the one before; in this it does").arg(rollouts_.world().log().real()));
    Then then;
    then.toDivergence = true;
    return show(*next, {}, then);
}

/// A breakpoint stopped the run: where that is because a robot leaves the real trajectory, it is the one to be asked
/// about.
void ShownRollout::showLeaving() {
    const Shown& shown = *frame_.session.current();
    if (shown.run != run_ || shown.branch != compared_) return;
    const Scene& scene = shown.frame->scene();
    const RolloutRow* const leaving =
        rollouts_.leavingAt([&](Nanoseconds time) { return scene.ticksOf(time) == shown.tick(); });
    if (leaving == nullptr) return;
    if (leaving != rollouts_.shownRow()) {
        const std::size_t robot = leaving->robot;
        view_.select(robot);
        setRobot(robot);
    }
    view_.showNearIfAside();
}

bool ShownRollout::show(std::size_t rollout, std::optional<std::size_t> robot, const Then& then) {
    if (!rollouts_.log() || rollout >= rollouts_.requests().size()) return false;
    if (!files_.saver().mayLeave([this, rollout, robot, then] { show(rollout, robot, then); })) return false;
    emit opens();
    opener_.open(
        rollouts_.log()->place,
        [log = rollouts_.log(), request = rollouts_.requests()[rollout],
         toLogEnd = playsToLogEnd(rollouts_.plan(), rollouts_.restarts())](const OpenProgress&) {
            return openRollout(*log, request, toLogEnd);
        },
        [this, rollout, robot, then](Expected<OpenedRun> run) { take(std::move(run), rollout, robot, then); });
    return true;
}

bool ShownRollout::showNext(int by, const Then& then) {
    if (!rollouts_.shown()) return false;
    const auto next = static_cast<std::int64_t>(*rollouts_.shown()) + by;
    if (next < 0 || next >= static_cast<std::int64_t>(rollouts_.requests().size())) return false;
    show(static_cast<std::size_t>(next), {}, then);
    return true;
}

void ShownRollout::take(Expected<OpenedRun> run, std::size_t rollout, std::optional<std::size_t> robot,
                        const Then& then) {
    if (!run) {
        emit failed(run.error());
        return emit taken();
    }
    emit done();
    const Shown* const shown = frame_.session.current().get();
    const bool sameLog = shown != nullptr && shown->run == run_;
    coming_ = Coming{run->setup, rollout, robot, run->reality, view_.keep(robot, sameLog), then};
    // Breakpoints go along from rollout to rollout.
    std::vector<Breakpoint> breakpoints;
    if (sameLog)
        for (const BreakpointState& state : shown->breakpoints) breakpoints.push_back(state.breakpoint);
    if (sameLog && inRollouts()) searcher_.hits().learn(*rollouts_.shown(), shown->breakpoints);
    files_.takeRollout(*run);
    if (!breakpoints.empty()) frame_.session.setBreakpoints(breakpoints);
    frame_.session.changeBreakpoints(
        [met = searcher_.hitsElsewhere(rollout)](Breakpoints& all) { all.setHitsInOtherRuns(met); });
    if (then.play) frame_.session.play();
}

/// A rollout that has been played to its end is followed by the next.
void ShownRollout::followShown() {
    if (coming_ && frame_.session.current()->setup == coming_->run) finishComing();
    const Shown& shown = *frame_.session.current();
    if (reloaded_ && shown.setup == reloaded_) {
        compared_ = shown.branch;
        reloaded_ = nullptr;
        reportDivergences();
        shownBranch_.reset();
    }
    if (rollouts_.shown() && shown.run == run_ && shownBranch_ != shown.branch) {
        shownBranch_ = shown.branch;
        emit changed();
    }
    if (shown.event == RunEvent::broke) showLeaving();
    if (!inRollouts() || opener_.busy() || coming_) return;
    if (shown.event == RunEvent::noBreak) return lookInOthers();
    if (shown.event != RunEvent::playedOut || !atRolloutEnd()) return;
    if (rollouts_.showsLast()) return sayLogEnds();
    if (files_.saver().hasUnsaved())
        return frame_.status.say(tr("This rollout has branches that are not saved: the next one waits"));
    Then on;
    on.play = true;
    showNext(1, on);
}

/// The run of a rollout is shown.
void ShownRollout::finishComing() {
    const Coming come = *std::exchange(coming_, std::nullopt);
    const Shown& shown = *frame_.session.current();
    if (!come.rollout) return frame_.session.setReality(shown.run, come.reality);
    run_ = shown.run;
    compared_ = 0;
    shownBranch_ = shown.branch;
    reloaded_ = nullptr;
    reality_ = come.reality;
    rollouts_.setShown(come.rollout);
    if (come.robot) rollouts_.setRobot(come.robot);
    view_.selectAgain(come.view);
    look();
    view_.showAgain(come.view);
    emit changed();
    if (come.then.toDivergence) goToDivergence();
    if (const auto& look = come.then.look)
        frame_.session.goToBreak(*look, look->back ? BreakReach::all : BreakReach::within);
    emit taken();
}

/// Whether the window shows one of the rollouts that follow each other.
bool ShownRollout::inRollouts() const {
    return rollouts_.follow() && rollouts_.shown() && frame_.session.current()->run == run_;
}

std::optional<std::int64_t> ShownRollout::endTick() const {
    const Shown* const shown = frame_.session.current().get();
    if (shown == nullptr || !rollouts_.shown() || shown->run != run_ || shown->branch != 0) return std::nullopt;
    return shown->frame->scene().ticksOf(rollouts_.length(*rollouts_.shown()));
}

void ShownRollout::seek(std::int64_t tick) {
    const std::int64_t end = endTick().value_or(tick);
    frame_.session.seek(std::min(tick, end));
    if (tick > end) frame_.status.say(tr("The rollout ends here: what the log commands next is not played"));
}

bool ShownRollout::atRolloutEnd() const {
    const Shown& shown = *frame_.session.current();
    return shown.tick() >= shown.frame->scene().ticksOf(rollouts_.length(*rollouts_.shown()));
}

void ShownRollout::sayLogEnds() {
    reportedEnd_ = run_;
    frame_.status.say(tr("The last rollout of the log is over; it can go on"));
}

bool ShownRollout::playsNext() {
    const Shown* const shown = frame_.session.current().get();
    if (shown == nullptr || !inRollouts() || opener_.busy() || coming_ || shown->branch != 0) return false;
    if (shown->tick() != shown->frame->scene().ticksOf(rollouts_.length(*rollouts_.shown()))) return false;
    Then on;
    on.play = true;
    if (!rollouts_.showsLast()) return !files_.saver().hasUnsaved() && showNext(1, on);
    if (reportedEnd_ == run_) return false;
    sayLogEnds();
    return true;
}

void ShownRollout::goToBreak(const BreakWish& wish) {
    searcher_.wish(wish);
    const bool within = frame_.session.current() != nullptr && inRollouts();
    if (within && !wish.back && atRolloutEnd()) return lookInOthers();
    frame_.session.goToBreak(wish, within ? BreakReach::within : BreakReach::on);
}

/// There is none in the shown rollout: in those after it, or before it.
void ShownRollout::lookInOthers() {
    if (!searcher_.wished()) return;
    const BreakWish wish = *searcher_.wished();
    const std::vector<BreakpointState>& states = frame_.session.current()->breakpoints;
    if (inRollouts()) searcher_.hits().learn(*rollouts_.shown(), states);
    std::vector<Breakpoint> breakpoints;
    bool diverges = wish.text == "divergence";
    for (const BreakpointState& state : states) {
        breakpoints.push_back(state.breakpoint);
        diverges = diverges || (state.breakpoint.enabled && state.breakpoint.text == "divergence");
    }
    const auto give = [this](const QString& why) {
        searcher_.stop();
        frame_.status.say(why);
    };
    if (files_.saver().hasUnsaved())
        return give(tr("This rollout has branches that are not saved: the other rollouts are not looked through"));
    if (diverges && !allCompared_)
        return give(tr("The other rollouts are still being compared: where they leave the log is known then"));
    searcher_.look(std::move(breakpoints), [this, wish](const Expected<std::optional<std::size_t>>& found) {
        if (!found) return frame_.status.say(qtText(found.error().message()));
        if (!*found) {
            reportDivergences();
            return frame_.status.say(wish.back ? tr("No break in this rollout up to here, nor in those before it")
                                               : tr("No break in the rest of this rollout, nor in those after it"));
        }
        Then then;
        then.look = wish;
        show(**found, {}, then);
    });
}

}  // namespace mrose::gui
