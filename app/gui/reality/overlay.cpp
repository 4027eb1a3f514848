#include "reality/overlay.h"

#include <QFileInfo>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <utility>

#include "files/window_files.h"
#include "frame/actions.h"
#include "frame/status_line.h"
#include "frame/window_memory.h"
#include "io/format.h"
#include "session/session.h"
#include "widgets/field_view.h"
#include "widgets/fixed_text.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr const char *overlayTopic = "overlay", *openingTopic = "opening log", *planTopic = "plan";

/// They go with the log.
QString noteTopic(std::size_t note) { return "log note " + QString::number(note); }

/// What opens sooner needs no word.
constexpr int openPatience = 300;  // ms

/// Why it is not every 10 s; empty: it is, or that was asked for.
QString planNote(const OverlayWorld& overlay, const OverlayPlan& plan) {
    if (plan == OverlayPlan{}) return {};
    const QString length = fixedText(plan.length, 1);
    const QString why = QObject::tr("The trajectories of %1 are short").arg(qtText(overlay.name()));
    switch (plan.cut) {
        case OverlayPlan::Cut::windows:
            return QObject::tr("%1: the simulation starts again in windows of %2 s, as mrose evaluate cuts them")
                .arg(why, length);
        case OverlayPlan::Cut::every:
            return QObject::tr("%1: the simulation starts again every %2 s").arg(why, length);
        case OverlayPlan::Cut::once:
            break;
    }
    return QObject::tr("%1: the simulation starts once").arg(why);
}

}  // namespace

Overlay::Overlay(const Frame& frame, FieldView& field, WindowFiles& files)
    : QObject(&frame.window), frame_(frame), field_(field), files_(files) {
    connect(&frame.session, &Session::shown, this, &Overlay::followShown);
}

Overlay::~Overlay() = default;

void Overlay::open(const OverlayRequest& request, const std::optional<OverlayPlan>& asked) { post({request, asked}); }

Expected<void> Overlay::openNow(const OverlayRequest& request, const std::optional<OverlayPlan>& asked) {
    openError_.reset();
    post({request, asked, false});
    opener_.settle();
    frame_.session.settle();
    if (openError_) return tl::unexpected(*openError_);
    return {};
}

/// What is open stays until the other one is there.
void Overlay::post(const Opening& wanted) {
    setAside();
    if (!frame_.actions.unattended())
        QTimer::singleShot(openPatience, this, [this, place = wanted.request.log, number = openings_] {
            if (number == openings_ && opener_.busy()) reportOpening(place);
        });
    const auto job = [this, wanted, restarts = restarts_](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        OpenProgress progress;
        progress.goesOn = goesOn;
        Opening opening = wanted;
        auto opened = std::make_shared<Expected<OpenedLog>>(
            openLogAsRun(wanted.request, wanted.asked, restarts, progress, opening.kindUnknown));
        return [this, opened, opening] { takeOpened(std::move(*opened), opening); };
    };
    opener_.post(job, [this, wanted](const Error& error) { takeOpened(tl::unexpected(error), wanted); });
}

void Overlay::reportOpening(const std::string& place) {
    frame_.messages.add({MessageBar::Kind::progress,
                         tr("Opening %1").arg(QFileInfo(qtText(place)).fileName()),
                         openingTopic,
                         {{tr("Cancel"), tr("Do not open it (Esc)"), [this] { setAside(), readAgain(); }}}});
}

/// The newest wish counts; what has changed in the files is read after it.
void Overlay::setAside() {
    opener_.drop();
    if (reading_ && !reload_) reload_ = reading_;
    reading_.reset();
    endOpening();
}

/// Nothing more is said of it.
void Overlay::endOpening() {
    ++openings_;
    frame_.messages.remove(openingTopic);
}

void Overlay::takeOpened(Expected<OpenedLog> opened, const Opening& opening) {
    endOpening();
    if (!opened) {
        if (opening.kindUnknown && opening.mayAsk && !frame_.actions.unattended())
            emit robotKindUnknown(opening.request, opening.asked);
        else
            sayError(opened.error());
        return readAgain();
    }
    if (!files_.mayLeave([this, opening] { post(opening); })) return readAgain();
    close();
    begin(std::move(opened->world), opened->plan, std::move(opened->requests));
    if (const QString note = opening.asked ? QString() : planNote(*world_, plan_); !note.isEmpty())
        frame_.messages.add({MessageBar::Kind::note, note, planTopic});
    frame_.memory.addRecent(qtText(world_->place));
    takeRollout(std::move(opened->run), opened->rollout, {}, Then{});
    compareAll();
}

void Overlay::follow(const OpenRun& run) {
    close();
    if (!follows_ || run.setup->scenario->parts().players.empty()) return;
    OverlayRequest request{run.source.log, run.source.file};
    request.seed = run.source.seed;
    request.pluginLimit = run.source.pluginLimit;
    if (run.recorded()) request.kept = run.setup->value;
    const auto alone = [this](const Error& error) {
        const QString why = qtText(error.message());
        frame_.messages.add({MessageBar::Kind::note, tr("The run is shown alone: %1").arg(why), overlayTopic});
    };
    const auto job = [this, request, followed = run.setup, alone](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        OpenProgress progress;
        progress.goesOn = goesOn;
        auto world = std::make_shared<Expected<OverlayWorldPointer>>(openOverlayWorld(request, progress));
        return [this, world, followed, alone] {
            if (*world) return takeFollowed(std::move(**world), followed);
            alone(world->error());
        };
    };
    opener_.post(job, alone);
}

/// What is on its way to be shown comes first.
bool Overlay::reload(const QString& why) {
    if (!shownRollout_) return false;
    reload_ = why;
    if (!opening()) readAgain();
    return true;
}

void Overlay::readAgain() {
    if (!reload_ || !world_ || !shownRollout_) return;
    reading_ = std::exchange(reload_, std::nullopt);
    const auto job = [this, world = world_, plan = plan_, shown = requests_[*shownRollout_], restarts = restarts_,
                      why = *reading_](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        auto again = std::make_shared<Expected<OpenedLog>>(reopen(*world, plan, shown, restarts, goesOn));
        return [this, again, why] { takeReopened(std::move(*again), why); };
    };
    opener_.post(job, [this, why = *reading_](const Error& error) { takeReopened(tl::unexpected(error), why); });
}

void Overlay::takeReopened(Expected<OpenedLog> again, const QString& why) {
    reading_.reset();
    if (!again) {
        files_.takeReloaded(tl::unexpected(again.error()), why);
        return readAgain();
    }
    if (world_ && again->world->files == world_->files) {
        files_.sayUnchanged();
        return readAgain();
    }
    adopt(again->world, std::move(again->requests));
    shownRollout_ = again->rollout;
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
    for (std::size_t note = 0; world_ && note < world_->notes.size(); ++note) frame_.messages.remove(noteTopic(note));
    // The one that is on its way to be shown, too.
    if (world_) frame_.session.setReality(frame_.session.newestRun(), nullptr);
    adopt(nullptr, {});
    for (const OverlayModel& model : models_) frame_.messages.remove(modelTopic(model.name));
    models_.clear();
    loading_.clear();
    robot_.reset();
    absent_.clear();
    reload_.reset();
    reading_.reset();
    share_ = 1;
    run_ = 0;
    reportDivergences();
    emit changed();
}

/// Nothing stays that is known of another world or of other rollouts.
void Overlay::adopt(OverlayWorldPointer world, std::vector<RolloutRequest> requests) {
    computing_.drop();
    stopSearching();
    coming_.reset();
    shownRollout_.reset();
    reality_ = nullptr;
    forgetRollout();
    if (world && world != world_) {
        // Models move in the world that they were made of.
        std::vector<WantedModel> wanted;
        for (const OverlayModel& model : models_)
            if (!model.named.empty()) wanted.push_back({model.named, model.shown});
        loading_.insert(loading_.begin(), wanted.begin(), wanted.end());
        models_ = {ownModel(*world)};
        bound_.fromHeldOut = bound_.fromHeldOut && knowsHeldOut(world->world());
    }
    world_ = std::move(world);
    requests_ = std::move(requests);
    comparison_ = nullptr;
    error_.clear();
    hits_.clear();
    setRows({});
}

void Overlay::sayError(const Error& error) {
    openError_ = error;
    frame_.messages.add({MessageBar::Kind::error, qtText(error.message()), overlayTopic});
}

void Overlay::begin(OverlayWorldPointer world, const OverlayPlan& plan, std::vector<RolloutRequest> rollouts) {
    plan_ = plan;
    for (const std::string& named : world->request.models) loading_.push_back({named});
    bound_ = {DivergenceBound{}.constant, knowsHeldOut(world->world())};
    adopt(std::move(world), std::move(rollouts));
    frame_.messages.remove(overlayTopic);
    for (std::size_t note = 0; note < world_->notes.size(); ++note)
        frame_.messages.add({MessageBar::Kind::note, qtText(world_->notes[note]), noteTopic(note)});
}

void Overlay::takeFollowed(OverlayWorldPointer world, const BranchSetupPointer& followed) {
    const OverlayPlan plan = suitedPlan(*world);
    auto rollouts = plannedRollouts(*world, plan);
    if (!rollouts) return sayError(rollouts.error());
    begin(std::move(world), plan, std::move(*rollouts));
    const auto reality = std::make_shared<const Reality>(realityOf(world_->world(), 0, 0));
    coming_ = Coming{followed, {}, {}, {}, reality};
    if (frame_.session.current()) followShown();
    compareAll();
}

Expected<void> Overlay::setPlan(const OverlayPlan& plan) {
    if (!world_ || plan == plan_) return {};
    auto rollouts = plannedRollouts(*world_, plan);
    if (!rollouts) return tl::unexpected(rollouts.error());
    if (!files_.mayLeave([this, plan] { (void)setPlan(plan); })) return {};
    plan_ = plan;
    frame_.messages.remove(planTopic);
    adopt(world_, std::move(*rollouts));
    show(0);
    compareAll();
    return {};
}

DivergenceOptions Overlay::divergenceOptions() const {
    DivergenceOptions options;
    options.bound.constant = bound_.at;
    options.fromHeldOut = bound_.fromHeldOut;
    return options;
}

void Overlay::setBound(const Bound& bound) {
    if (bound == bound_) return;
    bound_ = bound;
    if (comparison_)
        setRows(overlayRows(world_->world(), comparison_->rollouts, requests_, divergenceOptions()));
    else if (world_)
        compareAll();
    reportDivergences();
    findCause();
    emit changed();
}

void Overlay::setRows(std::vector<OverlayRow> rows) {
    rows_ = std::move(rows);
    hits_.forget("divergence");
    ++rowsVersion_;
}

void Overlay::compareAll() {
    if (!world_) return;
    computing_.drop();
    setRows({});
    comparison_ = nullptr;
    share_ = 0;
    error_.clear();
    emit changed();
    const auto job = [this, world = world_, requests = requests_,
                      bounds = divergenceOptions()](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        const auto report = [&](std::vector<OverlayRow> rows, double share) {
            computing_.report([this, rows = std::move(rows), share] { takeRows(rows, share); });
            return goesOn();
        };
        auto compared = std::make_shared<Expected<Comparison>>(compareRollouts(*world, requests, bounds, report));
        return [this, compared] { takeComparison(std::move(*compared)); };
    };
    computing_.post(job, [this](const Error& error) { takeComparison(tl::unexpected(error)); });
    compareModels();
}

void Overlay::takeRows(const std::vector<OverlayRow>& rows, double share) {
    share_ = std::min(share, 0.999);
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    ++rowsVersion_;
    if (!finding_ && shownRow() != nullptr) {
        reportDivergences();
        findCause();
    }
    emit changed();
}

void Overlay::takeComparison(Expected<Comparison> comparison) {
    share_ = 1;
    if (comparison) {
        comparison_ = std::make_shared<const Comparison>(std::move(*comparison));
        models_.front().figures.compared = comparison_->all;
    } else {
        error_ = qtText(comparison.error().message());
        models_.front().figures.compared = tl::unexpected(comparison.error());
        sayError(comparison.error());
    }
    emit changed();
}

const OverlayRow* Overlay::rowOf(std::size_t rollout, std::size_t robot) const {
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), std::pair(rollout, robot),
                                        [](const OverlayRow& row, const std::pair<std::size_t, std::size_t>& of) {
                                            return std::pair(row.rollout, row.robot) < of;
                                        });
    return found != rows_.end() && found->rollout == rollout && found->robot == robot ? &*found : nullptr;
}

bool Overlay::show(std::size_t rollout, std::optional<std::size_t> robot, const Then& then) {
    if (!world_ || rollout >= requests_.size()) return false;
    if (!files_.mayLeave([this, rollout, robot, then] { show(rollout, robot, then); })) return false;
    setAside();
    const auto job = [this, world = world_, rollout, request = requests_[rollout], robot, then,
                      commandsToLogEnd = playsToLogEnd(plan_, restarts_)](const JobQueue::GoesOn&) -> JobQueue::Answer {
        auto run = std::make_shared<Expected<OpenRun>>(openRollout(*world, request, commandsToLogEnd));
        return [this, run, rollout, robot, then] { takeRollout(std::move(*run), rollout, robot, then); };
    };
    opener_.post(job, [this, rollout, robot, then](const Error& error) {
        takeRollout(tl::unexpected(error), rollout, robot, then);
    });
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
    const FieldView& field = field_;
    coming_ = Coming{run->setup, rollout, robot, absent_, run->reality, robot.has_value(), {}, then};
    if (robot)
        coming_->selected = world_->world().robots()[*robot].name;
    else if (const auto body = field.selected(); body && shown != nullptr)
        coming_->selected = shown->frame->nameOf(*body);
    // Breakpoints and the view go along from rollout to rollout.
    std::vector<Breakpoint> breakpoints;
    if (shown != nullptr && shown->run == run_) {
        for (const BreakpointState& state : shown->breakpoints) breakpoints.push_back(state.breakpoint);
        learnHits();
        coming_->near = robot || field.showsPart();
        if (!field.showsAll()) coming_->view = field.transform();
    }
    files_.takeRollout(*run);
    if (!breakpoints.empty()) frame_.session.setBreakpoints(breakpoints);
    reportHits(rollout);
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
    if (shownRollout_ && shown.run == run_ && shownBranch_ != shown.branch) {
        shownBranch_ = shown.branch;
        emit changed();
    }
    if (shown.event == RunEvent::broke) showLeaving();
    if (!inRollouts() || opening()) return;
    if (shown.event == RunEvent::noBreak) return lookInRollouts();
    if (shown.event != RunEvent::playedOut || !atRolloutEnd()) return;
    if (isLastRollout()) return sayLogEnds();
    if (files_.hasUnsaved())
        return frame_.status.say(tr("This rollout has branches that are not saved: the next one waits"));
    Then on;
    on.play = true;
    showNext(1, on);
}

/// The run of a rollout is shown.
void Overlay::finishComing() {
    const Coming come = *std::exchange(coming_, std::nullopt);
    if (!come.rollout) return frame_.session.setReality(frame_.session.current()->run, come.reality);
    run_ = frame_.session.current()->run;
    compared_ = 0;
    shownBranch_ = frame_.session.current()->branch;
    reloaded_ = nullptr;
    reality_ = come.reality;
    shownRollout_ = come.rollout;
    if (come.robot) robot_ = come.robot;
    selectAgain(come.selected);
    lookAtRollout();
    showAsBefore(come);
    emit changed();
    if (come.then.toDivergence) goToDivergence();
    if (const auto& look = come.then.look)
        frame_.session.goToBreak(*look, look->back ? BreakReach::all : BreakReach::within);
    readAgain();
}

bool Overlay::showNext(int by, const Then& then) {
    if (!world_ || !shownRollout_) return false;
    const auto next = static_cast<std::int64_t>(*shownRollout_) + by;
    if (next < 0 || next >= static_cast<std::int64_t>(requests_.size())) return false;
    show(static_cast<std::size_t>(next), {}, then);
    return true;
}

void Overlay::setRestarts(bool on) {
    if (restarts_ == on) return;
    restarts_ = on;
    emit changed();
}

bool Overlay::cancel() {
    // What is waited for, before what is done beside it.
    if (searching_.busy()) return stopSearching(), true;
    if (!opener_.busy() && !computing_.busy() && !driving_.busy() && !diagnosing_.busy()) return false;
    for (JobQueue* const queue : {&opener_, &computing_, &driving_, &diagnosing_}) queue->drop();
    endOpening();
    reload_.reset();
    reading_.reset();
    loading_.clear();
    if (finding_ && finding_->share < 1) finding_.reset();
    if (share_ < 1 && world_) error_ = tr("Cancelled: not all rollouts are compared");
    share_ = 1;
    const auto cancelled = fail({}, "cancelled");
    for (OverlayModel& model : models_) {
        model.judged = 1;
        if (!model.figures.compared) model.figures.compared = cancelled;
        if (!model.figures.evaluated) model.figures.evaluated = cancelled;
    }
    emit changed();
    return true;
}

bool Overlay::busy() {
    return opening() || searching_.busy() || computing_.busy() || driving_.busy() || diagnosing_.busy();
}

void Overlay::settle() {
    while (busy()) {
        searching_.settle();
        opener_.settle();
        frame_.session.settle();
        coming_.reset();  // another run came in its place
        computing_.settle();
        driving_.settle();
        diagnosing_.settle();
    }
}

}  // namespace mrose::gui
