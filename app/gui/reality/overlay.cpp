#include "reality/overlay.h"

#include <algorithm>
#include <utility>

#include "files/window_files.h"
#include "frame/actions.h"
#include "frame/status_line.h"
#include "frame/window_memory.h"
#include "widgets/fixed_text.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr const char *overlayTopic = "overlay", *planTopic = "plan";

/// They go with the log.
QString noteTopic(std::size_t note) { return "log note " + QString::number(note); }

/// Why it is not every 10 s; empty: it is, or that was asked for.
QString planNote(const PlayedLog& log, const RolloutPlan& plan) {
    if (plan == RolloutPlan{}) return {};
    const QString length = fixedText(plan.length, 1);
    const QString why = QObject::tr("The trajectories of %1 are short").arg(qtText(log.name()));
    switch (plan.cut) {
        case RolloutPlan::Cut::windows:
            return QObject::tr("%1: the simulation starts again in windows of %2 s, as mrose evaluate cuts them")
                .arg(why, length);
        case RolloutPlan::Cut::every:
            return QObject::tr("%1: the simulation starts again every %2 s").arg(why, length);
        case RolloutPlan::Cut::once:
            break;
    }
    return QObject::tr("%1: the simulation starts once").arg(why);
}

OpenProgress whileWanted(const JobQueue::GoesOn& goesOn) {
    OpenProgress progress;
    progress.goesOn = goesOn;
    return progress;
}

}  // namespace

Overlay::Overlay(const Frame& frame, FieldView& field, WindowFiles& files)
    : QObject(&frame.window),
      frame_(frame),
      files_(files),
      models_(frame, rollouts_, computing_),
      causes_(rollouts_, models_),
      searcher_(rollouts_),
      view_(frame.session, field, rollouts_),
      opener_(frame) {
    connect(&frame.session, &Session::shown, this, &Overlay::followShown);
    connect(&models_, &LaidModels::changed, this, &Overlay::changed);
    connect(&models_, &LaidModels::laid, this, &Overlay::layReality);
    connect(&models_, &LaidModels::failed, this, &Overlay::sayError);
    connect(&causes_, &CauseFinder::changed, this, &Overlay::changed);
    connect(&causes_, &CauseFinder::laid, this, &Overlay::layReality);
    connect(&opener_, &LogOpener::cancelled, this, [this] { setAside(), readAgain(); });
}

void Overlay::open(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked) { post({request, asked}); }

Expected<void> Overlay::openNow(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked) {
    openError_.reset();
    post({request, asked, false});
    opener_.settle();
    frame_.session.settle();
    if (openError_) return tl::unexpected(*openError_);
    return {};
}

/// What is open stays until the other one is there.
void Overlay::post(const Opening& opening) {
    setAside();
    auto kindUnknown = std::make_shared<bool>(false);
    opener_.open(
        [opening, kindUnknown, restarts = rollouts_.restarts()](const JobQueue::GoesOn& goesOn) {
            return openLogAsRun(opening.request, opening.asked, restarts, whileWanted(goesOn), *kindUnknown);
        },
        [this, opening, kindUnknown](Expected<OpenedLog> opened) { take(std::move(opened), opening, *kindUnknown); });
    opener_.reportOpening(opening.request.log);
}

/// The newest wish counts; what has changed in the files is read after it.
void Overlay::setAside() {
    opener_.drop();
    if (reading_ && !reload_) reload_ = reading_;
    reading_.reset();
}

void Overlay::take(Expected<OpenedLog> opened, const Opening& opening, bool kindUnknown) {
    opener_.drop();
    if (!opened) {
        if (kindUnknown && opening.mayAsk && !frame_.actions.unattended())
            emit robotKindUnknown(opening.request, opening.asked);
        else
            sayError(opened.error());
        return readAgain();
    }
    if (!files_.mayLeave([this, opening] { post(opening); })) return readAgain();
    close();
    begin(std::move(opened->world), opened->plan, std::move(opened->requests));
    const PlayedLog& log = *rollouts_.log();
    if (const QString note = opening.asked ? QString() : planNote(log, rollouts_.plan()); !note.isEmpty())
        frame_.messages.add({MessageBar::Kind::note, note, planTopic});
    frame_.memory.addRecent(qtText(log.place));
    takeRollout(std::move(opened->run), opened->rollout, {}, Then{});
    compareAll();
}

void Overlay::follow(const OpenRun& run) {
    close();
    if (!follows_ || run.setup->scenario->parts().players.empty()) return;
    PlayedLogRequest request{run.source.log, run.source.file};
    request.seed = run.source.seed;
    request.pluginLimit = run.source.pluginLimit;
    if (run.recorded()) request.kept = run.setup->value;
    opener_.open(
        [request](const JobQueue::GoesOn& goesOn) { return openPlayedLog(request, whileWanted(goesOn)); },
        [this, followed = run.setup](Expected<PlayedLogPointer> log) {
            if (log) return takeFollowed(std::move(*log), followed);
            const QString why = qtText(log.error().message());
            frame_.messages.add({MessageBar::Kind::note, tr("The run is shown alone: %1").arg(why), overlayTopic});
        });
}

/// What is on its way to be shown comes first.
bool Overlay::reload(const QString& why) {
    if (!rollouts_.shown()) return false;
    reload_ = why;
    if (!opening()) readAgain();
    return true;
}

void Overlay::readAgain() {
    if (!reload_ || !rollouts_.shown()) return;
    reading_ = std::exchange(reload_, std::nullopt);
    opener_.open([log = rollouts_.log(), plan = rollouts_.plan(), shown = rollouts_.requests()[*rollouts_.shown()],
                  restarts = rollouts_.restarts()](
                     const JobQueue::GoesOn& goesOn) { return reopen(*log, plan, shown, restarts, goesOn); },
                 [this, why = *reading_](Expected<OpenedLog> again) { takeReopened(std::move(again), why); });
}

void Overlay::takeReopened(Expected<OpenedLog> again, const QString& why) {
    reading_.reset();
    if (!again) {
        files_.takeReloaded(tl::unexpected(again.error()), why);
        return readAgain();
    }
    if (isOpen() && again->world->files == rollouts_.log()->files) {
        files_.sayUnchanged();
        return readAgain();
    }
    replace(again->world, rollouts_.plan(), std::move(again->requests));
    rollouts_.setShown(again->rollout);
    compared_.reset();
    reloaded_ = again->run.setup;
    reality_ = again->run.reality;
    files_.takeReloaded(std::move(again->run), why);
    lookAtRollout();
    compareAll();
    readAgain();
}

void Overlay::close() {
    setAside();
    frame_.messages.remove(planTopic);
    for (std::size_t note = 0; isOpen() && note < rollouts_.log()->notes.size(); ++note)
        frame_.messages.remove(noteTopic(note));
    // The one that is on its way to be shown, too.
    if (isOpen()) frame_.session.setReality(frame_.session.newestRun(), nullptr);
    replace(nullptr, rollouts_.plan(), {});
    models_.clear();
    rollouts_.setRobot({});
    view_.forget();
    reload_.reset();
    reading_.reset();
    share_ = 1;
    run_ = 0;
    reportDivergences();
    emit changed();
}

/// Nothing stays that is known of another world or of other rollouts.
void Overlay::replace(PlayedLogPointer log, const RolloutPlan& plan, std::vector<RolloutRequest> rollouts) {
    computing_.drop();
    searcher_.stop();
    coming_.reset();
    reality_ = nullptr;
    const bool other = log && log != rollouts_.log();
    rollouts_.replace(std::move(log), plan, std::move(rollouts));
    models_.forgetDriven();
    causes_.forget();
    if (other) models_.enter({});
    error_.clear();
    searcher_.hits().clear();
}

void Overlay::sayError(const Error& error) {
    openError_ = error;
    frame_.messages.add({MessageBar::Kind::error, qtText(error.message()), overlayTopic});
}

void Overlay::begin(PlayedLogPointer log, const RolloutPlan& plan, std::vector<RolloutRequest> rollouts) {
    rollouts_.setBound({DivergenceBound{}.constant, knowsHeldOut(log->world())});
    replace(std::move(log), plan, std::move(rollouts));
    models_.enter(rollouts_.log()->request.models);
    frame_.messages.remove(overlayTopic);
    const std::vector<std::string>& notes = rollouts_.log()->notes;
    for (std::size_t note = 0; note < notes.size(); ++note)
        frame_.messages.add({MessageBar::Kind::note, qtText(notes[note]), noteTopic(note)});
}

void Overlay::takeFollowed(PlayedLogPointer log, const BranchSetupPointer& followed) {
    const RolloutPlan plan = suitedPlan(*log);
    auto rollouts = plannedRollouts(*log, plan);
    if (!rollouts) return sayError(rollouts.error());
    begin(std::move(log), plan, std::move(*rollouts));
    coming_ = Coming{followed, {}, {}, std::make_shared<const Reality>(realityOf(rollouts_.world(), 0, 0))};
    if (frame_.session.current()) followShown();
    compareAll();
}

Expected<void> Overlay::setPlan(const RolloutPlan& plan) {
    if (!isOpen() || plan == rollouts_.plan()) return {};
    auto rollouts = plannedRollouts(*rollouts_.log(), plan);
    if (!rollouts) return tl::unexpected(rollouts.error());
    if (!files_.mayLeave([this, plan] { (void)setPlan(plan); })) return {};
    frame_.messages.remove(planTopic);
    replace(rollouts_.log(), plan, std::move(*rollouts));
    show(0);
    compareAll();
    return {};
}

void Overlay::setBound(const LogRollouts::Bound& bound) {
    if (bound == rollouts_.bound()) return;
    rollouts_.setBound(bound);
    searcher_.hits().forget("divergence");
    if (isOpen() && rollouts_.comparison() == nullptr) compareAll();
    reportDivergences();
    causes_.find();
    emit changed();
}

void Overlay::setRestarts(bool on) {
    if (rollouts_.restarts() == on) return;
    rollouts_.setRestarts(on);
    emit changed();
}

void Overlay::setRobot(std::optional<std::size_t> robot) {
    // The selection goes and comes back with the run.
    if (robot == rollouts_.robotSet() || coming_) return;
    const auto before = rollouts_.robot();
    rollouts_.setRobot(robot);
    if (rollouts_.robot() != before) {
        causes_.find();
        emit divergencesChanged();
    }
    emit changed();
}

void Overlay::compareAll() {
    if (!isOpen()) return;
    computing_.drop();
    rollouts_.forgetRows();
    searcher_.hits().forget("divergence");
    share_ = 0;
    error_.clear();
    emit changed();
    computing_.run(
        [this, log = rollouts_.log(), requests = rollouts_.requests(),
         bounds = rollouts_.divergenceOptions()](const JobQueue::GoesOn& goesOn) {
            return compareRollouts(*log, requests, bounds, [&](std::vector<RolloutRow> rows, double share) {
                computing_.report([this, rows = std::move(rows), share] { takeRows(rows, share); });
                return goesOn();
            });
        },
        [this](Expected<Comparison> compared) { takeComparison(std::move(compared)); });
    models_.judge();
}

void Overlay::takeRows(const std::vector<RolloutRow>& rows, double share) {
    share_ = std::min(share, 0.999);
    rollouts_.addRows(rows);
    if (!causes_.finding() && rollouts_.shownRow() != nullptr) {
        reportDivergences();
        causes_.find();
    }
    emit changed();
}

void Overlay::takeComparison(Expected<Comparison> comparison) {
    share_ = 1;
    if (comparison) {
        models_.setOwnFigures(comparison->all);
        rollouts_.setComparison(std::move(*comparison));
    } else {
        error_ = qtText(comparison.error().message());
        models_.setOwnFigures(tl::unexpected(comparison.error()));
        sayError(comparison.error());
    }
    emit changed();
}

std::optional<LaidModels::Work> Overlay::work() const {
    if (!isOpen()) return {};
    if (share_ < 1) return LaidModels::Work{tr("comparing"), share_};
    return models_.work();
}

/// What the models make of the shown rollout, and why it leaves the real one.
void Overlay::lookAtRollout() {
    causes_.forget();
    models_.drive();
    if (!rollouts_.shown()) return;
    layReality();
    reportDivergences();
    causes_.find();
}

/// What really happened, with the rollouts of the models that are shown and of a cause.
void Overlay::layReality() {
    if (!reality_ || !rollouts_.shown()) return;
    auto laid = std::make_shared<Reality>(*reality_);
    laid->models = models_.drivenRollouts();
    if (auto rerun = causes_.shownRerun()) laid->models.push_back(std::move(*rerun));
    frame_.session.setReality(run_, std::move(laid));
}

void Overlay::reportDivergences() {
    emit divergencesChanged();
    if (!isOpen()) return frame_.session.changeBreakpoints([](Breakpoints& all) { all.setDivergence({}); });
    if (!rollouts_.shown() || frame_.session.current() == nullptr) return;
    LeavingRobots leaving = leavingRobots(rollouts_.world(), rollouts_.rowsOf(*rollouts_.shown()));
    leaving.reality = reality_;
    leaving.compared = compared_;
    frame_.session.changeBreakpoints([leaving, met = searcher_.hitsElsewhere(*rollouts_.shown())](Breakpoints& all) {
        all.setDivergence({leavesReality(leaving), whoLeaves(leaving)});
        all.setHitsInOtherRuns(met);
    });
}

bool Overlay::goToDivergence() {
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
    frame_.status.say(tr("Nothing leaves the real trajectory in the one before; in this it does"));
    Then then;
    then.toDivergence = true;
    return show(*next, {}, then);
}

/// A breakpoint stopped the run: where that is because a robot leaves the real trajectory, it is the one to be asked
/// about.
void Overlay::showLeaving() {
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

bool Overlay::show(std::size_t rollout, std::optional<std::size_t> robot, const Then& then) {
    if (!isOpen() || rollout >= rollouts_.requests().size()) return false;
    if (!files_.mayLeave([this, rollout, robot, then] { show(rollout, robot, then); })) return false;
    setAside();
    opener_.open(
        [log = rollouts_.log(), request = rollouts_.requests()[rollout],
         toLogEnd = playsToLogEnd(rollouts_.plan(), rollouts_.restarts())](const JobQueue::GoesOn&) {
            return openRollout(*log, request, toLogEnd);
        },
        [this, rollout, robot, then](Expected<OpenRun> run) { takeRollout(std::move(run), rollout, robot, then); });
    return true;
}

bool Overlay::showNext(int by, const Then& then) {
    if (!rollouts_.shown()) return false;
    const auto next = static_cast<std::int64_t>(*rollouts_.shown()) + by;
    if (next < 0 || next >= static_cast<std::int64_t>(rollouts_.requests().size())) return false;
    show(static_cast<std::size_t>(next), {}, then);
    return true;
}

void Overlay::takeRollout(Expected<OpenRun> run, std::size_t rollout, std::optional<std::size_t> robot,
                          const Then& then) {
    if (!run) {
        sayError(run.error());
        return readAgain();
    }
    frame_.messages.remove(overlayTopic);
    const Shown* const shown = frame_.session.current();
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
void Overlay::followShown() {
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
    if (!inRollouts() || opening()) return;
    if (shown.event == RunEvent::noBreak) return lookInOthers();
    if (shown.event != RunEvent::playedOut || !atRolloutEnd()) return;
    if (rollouts_.showsLast()) return sayLogEnds();
    if (files_.hasUnsaved())
        return frame_.status.say(tr("This rollout has branches that are not saved: the next one waits"));
    Then on;
    on.play = true;
    showNext(1, on);
}

/// The run of a rollout is shown.
void Overlay::finishComing() {
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
    lookAtRollout();
    view_.showAgain(come.view);
    emit changed();
    if (come.then.toDivergence) goToDivergence();
    if (const auto& look = come.then.look)
        frame_.session.goToBreak(*look, look->back ? BreakReach::all : BreakReach::within);
    readAgain();
}

/// Whether the window shows one of the rollouts that follow each other.
bool Overlay::inRollouts() const {
    return rollouts_.follow() && rollouts_.shown() && frame_.session.current()->run == run_;
}

bool Overlay::atRolloutEnd() const {
    const Shown& shown = *frame_.session.current();
    return shown.tick() >= shown.frame->scene().ticksOf(rollouts_.length(*rollouts_.shown()));
}

void Overlay::sayLogEnds() {
    reportedEnd_ = run_;
    frame_.status.say(tr("The last rollout of the log is over; it can go on"));
}

bool Overlay::playsNext() {
    const Shown* const shown = frame_.session.current();
    if (shown == nullptr || !inRollouts() || opening() || shown->branch != 0) return false;
    if (shown->tick() != shown->frame->scene().ticksOf(rollouts_.length(*rollouts_.shown()))) return false;
    Then on;
    on.play = true;
    if (!rollouts_.showsLast()) return !files_.hasUnsaved() && showNext(1, on);
    if (reportedEnd_ == run_) return false;
    sayLogEnds();
    return true;
}

void Overlay::goToBreak(const BreakWish& wish) {
    searcher_.wish(wish);
    const bool within = frame_.session.current() != nullptr && inRollouts();
    if (within && !wish.back && atRolloutEnd()) return lookInOthers();
    frame_.session.goToBreak(wish, within ? BreakReach::within : BreakReach::on);
}

/// There is none in the shown rollout: in those after it, or before it.
void Overlay::lookInOthers() {
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
    if (files_.hasUnsaved())
        return give(tr("This rollout has branches that are not saved: the other rollouts are not looked through"));
    if (diverges && share_ < 1)
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

bool Overlay::cancel() {
    // What is waited for, before what is done beside it.
    if (searcher_.busy()) return searcher_.stop(), true;
    if (!opener_.busy() && !computing_.busy() && !models_.busy() && !causes_.busy()) return false;
    opener_.drop();
    computing_.drop();
    reload_.reset();
    reading_.reset();
    models_.giveUp();
    causes_.giveUp();
    if (share_ < 1 && isOpen()) error_ = tr("Cancelled: not all rollouts are compared");
    share_ = 1;
    emit changed();
    return true;
}

bool Overlay::busy() { return opening() || searcher_.busy() || computing_.busy() || models_.busy() || causes_.busy(); }

void Overlay::settle() {
    while (busy()) {
        searcher_.settle();
        opener_.settle();
        frame_.session.settle();
        coming_.reset();  // another run came in its place
        computing_.settle();
        models_.settle();
        causes_.settle();
    }
}

}  // namespace mrose::gui
