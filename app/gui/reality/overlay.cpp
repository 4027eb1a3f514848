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

}  // namespace

Overlay::Overlay(const WindowFrame& frame, FieldView& field, WindowFiles& files)
    : QObject(&frame.window),
      frame_(frame),
      files_(files),
      comparing_(rollouts_, computing_),
      models_(frame, rollouts_, computing_),
      causes_(rollouts_, models_),
      searcher_(rollouts_),
      opener_(frame, "opening log"),
      shown_(frame, field, files, {rollouts_, models_, causes_, searcher_, opener_}) {
    connect(&shown_, &ShownRollout::changed, this, &Overlay::changed);
    connect(&shown_, &ShownRollout::divergencesChanged, this, &Overlay::divergencesChanged);
    connect(&shown_, &ShownRollout::opens, this, &Overlay::setAside);
    connect(&shown_, &ShownRollout::taken, this, &Overlay::readAgain);
    connect(&shown_, &ShownRollout::failed, this, &Overlay::sayError);
    connect(&shown_, &ShownRollout::done, this, [this] { frame_.messages.remove(overlayTopic); });
    connect(&comparing_, &RolloutComparer::begun, this, [this] {
        searcher_.hits().forget("divergence");
        shown_.setCompared(false);
        emit changed();
    });
    connect(&comparing_, &RolloutComparer::grown, this, [this] {
        if (!causes_.finding() && rollouts_.shownRow() != nullptr) {
            shown_.reportDivergences();
            causes_.find();
        }
        emit changed();
    });
    connect(&comparing_, &RolloutComparer::ended, this, [this](const Expected<ComparedSummary>& all) {
        shown_.setCompared(true);
        models_.setOwnFigures(all);
        if (!all) sayError(all.error());
        emit changed();
    });
    connect(&models_, &LaidModels::changed, this, &Overlay::changed);
    connect(&models_, &LaidModels::failed, this, &Overlay::sayError);
    connect(&causes_, &CauseFinder::changed, this, &Overlay::changed);
    connect(&opener_, &OpeningQueue::cancelled, this, [this] { setAside(), readAgain(); });
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
        opening.request.log,
        [opening, kindUnknown, restarts = rollouts_.restarts()](const OpenProgress& progress) {
            return openLogAsRun(opening.request, opening.asked, restarts, progress, kindUnknown.get());
        },
        [this, opening, kindUnknown](Expected<OpenedLog> opened) { take(std::move(opened), opening, *kindUnknown); });
}

/// The newest wish counts; what has changed in the files is read after it.
void Overlay::setAside() {
    opener_.cancel();
    if (reading_ && !reload_) reload_ = reading_;
    reading_.reset();
}

void Overlay::take(Expected<OpenedLog> opened, const Opening& opening, bool kindUnknown) {
    if (!opened) {
        if (kindUnknown && opening.mayAsk && !frame_.actions.unattended())
            emit robotKindUnknown(opening.request, opening.asked);
        else
            sayError(opened.error());
        return readAgain();
    }
    if (!files_.saver().mayLeave([this, opening] { post(opening); })) return readAgain();
    leave();
    begin(std::move(opened->world), opened->plan, std::move(opened->requests));
    const PlayedLog& log = *rollouts_.log();
    if (const QString note = opening.asked ? QString() : planNote(log, rollouts_.plan()); !note.isEmpty())
        frame_.messages.add({MessageBar::Kind::note, note, planTopic});
    frame_.memory.addRecent(qtText(log.place));
    shown_.take(std::move(opened->run), opened->rollout);
    compareAll();
}

void Overlay::follow(const OpenedRun& run) {
    if (!follows_ || run.setup->scenario->parts().players.empty()) return close();
    leave();
    PlayedLogRequest request{run.source.log, run.source.file};
    request.seed = run.source.seed;
    request.pluginLimit = run.source.pluginLimit;
    if (run.recorded()) request.kept = run.setup->value;
    opener_.open(
        request.log.empty() ? request.scenario : request.log,
        [request](const OpenProgress& progress) { return openPlayedLog(request, progress); },
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
    opener_.open(
        rollouts_.log()->place,
        [log = rollouts_.log(), plan = rollouts_.plan(), shown = rollouts_.requests()[*rollouts_.shown()],
         restarts = rollouts_.restarts()](const OpenProgress& progress) {
            return reopen(*log, plan, shown, restarts, progress);
        },
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
    shown_.takeReopened(again->rollout, again->run);
    files_.takeReloaded(std::move(again->run), why);
    shown_.look();
    compareAll();
    readAgain();
}

/// For another one, or for good.
void Overlay::leave() {
    setAside();
    frame_.messages.remove(planTopic);
    for (std::size_t note = 0; isOpen() && note < rollouts_.log()->notes.size(); ++note)
        frame_.messages.remove(noteTopic(note));
    // The one that is on its way to be shown, too.
    if (isOpen()) frame_.session.setReality(frame_.session.newestRun(), nullptr);
    replace(nullptr, rollouts_.plan(), {});
    models_.clear();
    rollouts_.setRobot({});
    reload_.reset();
    reading_.reset();
    comparing_.forget();
    shown_.reportDivergences();
    emit changed();
}

/// Nothing stays that is known of another world or of other rollouts.
void Overlay::replace(PlayedLogPointer log, const RolloutPlan& plan, std::vector<RolloutRequest> rollouts) {
    computing_.drop();
    searcher_.stop();
    const bool other = log && log != rollouts_.log();
    rollouts_.replace(std::move(log), plan, std::move(rollouts));
    shown_.forget();
    models_.forgetDriven();
    causes_.forget();
    if (other) models_.enter({});
    comparing_.forget();
    searcher_.hits().clear();
}

void Overlay::sayError(const Error& error) {
    openError_ = error;
    frame_.messages.add({MessageBar::Kind::error, qtText(error.message()), overlayTopic});
}

void Overlay::begin(PlayedLogPointer log, const RolloutPlan& plan, std::vector<RolloutRequest> rollouts) {
    rollouts_.setBound({DivergenceBound{}.constant, boundSource(log->world()) != BoundSource::constant});
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
    shown_.takeFollowed(followed, std::make_shared<const Reality>(realityOf(rollouts_.world(), 0, 0)));
    compareAll();
}

Expected<void> Overlay::setPlan(const RolloutPlan& plan) {
    if (!isOpen() || plan == rollouts_.plan()) return {};
    auto rollouts = plannedRollouts(*rollouts_.log(), plan);
    if (!rollouts) return tl::unexpected(rollouts.error());
    if (!files_.saver().mayLeave([this, plan] { (void)setPlan(plan); })) return {};
    frame_.messages.remove(planTopic);
    replace(rollouts_.log(), plan, std::move(*rollouts));
    shown_.show(0);
    compareAll();
    return {};
}

void Overlay::setBound(const LogRollouts::Bound& bound) {
    if (bound == rollouts_.bound()) return;
    rollouts_.setBound(bound);
    searcher_.hits().forget("divergence");
    if (isOpen() && rollouts_.comparison() == nullptr) compareAll();
    shown_.reportDivergences();
    causes_.find();
    emit changed();
}

void Overlay::setRestarts(bool on) {
    if (rollouts_.restarts() == on) return;
    rollouts_.setRestarts(on);
    emit changed();
}

void Overlay::compareAll() {
    if (!isOpen()) return;
    comparing_.compareAll();
    models_.judge();
}

std::optional<LaidModels::Work> Overlay::work() const {
    if (!isOpen()) return {};
    if (comparing_.share() < 1) return LaidModels::Work{tr("comparing"), comparing_.share()};
    return models_.work();
}

bool Overlay::cancel() {
    // What is waited for, before what is done beside it.
    if (searcher_.busy()) return searcher_.stop(), true;
    if (!opener_.busy() && !computing_.busy() && !models_.busy() && !causes_.busy()) return false;
    opener_.cancel();
    computing_.drop();
    reload_.reset();
    reading_.reset();
    models_.giveUp();
    causes_.giveUp();
    comparing_.cancel();
    shown_.setCompared(true);
    emit changed();
    return true;
}

bool Overlay::busy() { return opening() || searcher_.busy() || computing_.busy() || models_.busy() || causes_.busy(); }

void Overlay::settle() {
    while (busy()) {
        searcher_.settle();
        opener_.settle();
        frame_.session.settle();
        shown_.setAside();  // another run came in its place
        computing_.settle();
        models_.settle();
        causes_.settle();
    }
}

}  // namespace mrose::gui
