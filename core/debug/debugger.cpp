#include "debug/debugger.h"

#include <algorithm>
#include <iterator>

#include "debug/kick_cause.h"
#include "debug/play_end.h"
#include "io/format.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr std::int64_t askedEvery = 16;  // ticks

const char* const endedEarly = "Ended before a break was found";

bool goesOn(const Watch& watch, double share) { return !watch.goesOn || watch.goesOn(share); }

double shareOf(std::int64_t done, std::int64_t all) { return static_cast<double>(done) / static_cast<double>(all); }

}  // namespace

void Debugger::open(const OpenedRun& run) {
    run_.emplace(run);
    breakpoints_.forgetRun();
    stop();
    end_.reset();
    waiting_.reset();
    event_ = RunEvent::none;
    subject_.reset();
    goal_.reset();
    happened_.reset();
    marks_.reset();
}

std::string Debugger::secondsAt(std::int64_t tick) const {
    return fixed(toSeconds(run_->setup().scene().timeOf(tick)), 2);
}

std::int64_t Debugger::playsTo() const { return end_.value_or(usualEnd(*run_)); }

void Debugger::stop(const std::string& why) {
    playing_ = false;
    atBreak_ = false;
    goal_.reset();
    message_ = why;
}

void Debugger::play() {
    message_.clear();
    playing_ = true;
}

void Debugger::stepBy(std::int64_t ticks) {
    stop();
    Expected<void> done;
    if (ticks < 0)
        done = run_->seek(run_->tick() + ticks);
    else
        for (std::int64_t i = 0; i < ticks && done; ++i) done = run_->forward();
    if (!done) message_ = done.error().message();
}

void Debugger::goTo(std::int64_t tick, bool breaks, const Watch& watch) {
    message_.clear();
    atBreak_ = false;
    waiting_.reset();
    const std::int64_t from = run_->tick();
    Expected<void> done = run_->seek(tick);
    while (done && run_->tick() < tick) {
        if (breaks) breakpoints_.leave(*run_);
        done = run_->forward();
        if (done && breaks && stopsHere(watch.goesOn)) break;
        if (run_->tick() % askedEvery != 0) continue;
        if (!goesOn(watch, shareOf(run_->tick() - from, tick - from))) break;
        goal_ = tick;
        if (watch.between) watch.between();
    }
    goal_.reset();
    if (!done) message_ = done.error().message();
}

void Debugger::show(std::uint32_t branch, std::int64_t tick) {
    if (branch >= run_->branches().size()) return;
    message_.clear();
    if (auto done = run_->show(branch, tick); !done)
        message_ = done.error().message();
    else if (run_->tick() != tick)
        message_ = "This branch has not come to " + secondsAt(tick) + " s: it is shown at " + secondsAt(run_->tick()) +
                   " s, the nearest that it has";
}

bool Debugger::branchOff(const Edit& edit) {
    stop();
    const auto done = run_->branchOff(edit);
    message_ = done ? edit.note : done.error().message();
    return done.has_value();
}

void Debugger::sayBranched() {
    if (!message_.empty()) return;
    message_ = run_->origin(run_->branch()).replaced
                   ? "This branch now begins with \u201c" + run_->branches()[run_->branch()].name +
                         "\u201d: Space plays it, S shows both branches side by side"
                   : "A branch begins here: Space plays it, S shows both branches side by side";
}

void Debugger::undo() {
    const std::string what = run_->origin(run_->branch()).edit;
    if (run_->undo()) stop("Undone: " + what + "; " + secondsAt(run_->tick()) + " s is shown as it was before");
}

void Debugger::redo() {
    if (run_->redo()) stop("Done again: " + run_->origin(run_->branch()).edit);
}

void Debugger::removeBranch(std::uint32_t branch) {
    const std::string name = branch < run_->branches().size() ? run_->branches()[branch].name : "";
    stop(run_->remove(branch) ? "Deleted: " + name + ", with what departed from it"
                              : "The run itself cannot be deleted");
}

void Debugger::removeOtherBranches() {
    const std::size_t count = run_->removeOthers();
    stop(count > 0 ? "Deleted: " + counted(count, "branch", "branches") : "There are no other branches");
}

void Debugger::restoreBranches() {
    const std::size_t count = run_->restore();
    stop(count > 0 ? "Brought back: " + counted(count, "branch", "branches") : "Nothing was deleted");
}

void Debugger::showCauseOfKick() {
    const auto cause = causeOfKick(*run_);
    stop(cause ? "" : "No kick up to here: let it play, or go to a kick on the timeline");
    if (!cause) return;
    // The state after the decision is the first that shows it.
    if (auto done = run_->seek(cause->order.tick + 1); !done) return stop(done.error().message());
    message_ = run_->setup().scene().robots[cause->order.robot].name + " decided here to kick; the kick of " +
               secondsAt(cause->kicked) + " s is its work. E changes what it decided";
    subject_ = cause->order.robot;
}

void Debugger::setReality(std::shared_ptr<const Reality> reality) {
    if (!isSameTruth(run_->reality(), reality)) breakpoints_.forgetAnswers();
    run_->setReality(std::move(reality));
}

/// The run has come to another tick: whether it is to stand there, if only until it is known whether it is to stop.
bool Debugger::stopsHere(const Progress& goesOn) {
    const auto arrival = breakpoints_.arrive(*run_, [&](double share) { return !goesOn || goesOn(share); });
    waiting_.reset();
    atBreak_ = false;
    if (!arrival) return stop(arrival.error().message()), true;
    if (!arrival->known) waiting_.emplace(run_->branch(), run_->tick());
    if (arrival->why) stop(*arrival->why);
    atBreak_ = arrival->why.has_value();
    if (atBreak_) event_ = RunEvent::broke;
    return atBreak_ || !arrival->known;
}

void Debugger::arrive(const Progress& goesOn) {
    if (stopsHere(goesOn) || run_->tick() != playsTo()) return;
    stop(endText(*run_));
    event_ = RunEvent::playedOut;
}

void Debugger::playOn(const Progress& goesOn) {
    if (!waits()) {
        breakpoints_.leave(*run_);
        if (auto done = run_->forward(); !done) return stop(done.error().message());
    }
    arrive(goesOn);
}

void Debugger::goToBreak(const BreakWish& wish, BreakReach reach, const Watch& watch) {
    stop();
    if (wish.back)
        backToBreak(wish, reach, watch);
    else
        runToBreak(reach, watch);
}

void Debugger::goToStop(const Breakpoints::Answer& answer, const std::string& none, bool ended) {
    if (!answer) return stop(answer.error().message());
    if (ended) return stop(endedEarly);
    if (!*answer) {
        event_ = RunEvent::noBreak;
        return stop(none);
    }
    if (auto done = run_->seek((*answer)->tick); !done) return stop(done.error().message());
    stop(breakpoints_.stopped(*run_, **answer));
    atBreak_ = true;
    event_ = RunEvent::broke;
}

void Debugger::backToBreak(const BreakWish& wish, BreakReach reach, const Watch& watch) {
    const bool fromEnd = reach == BreakReach::all;
    if (fromEnd)
        if (auto done = simulateToEnd(watch); !done) return stop(done.error().message());
    const std::int64_t before = run_->tick() + (fromEnd ? 1 : 0);
    const auto found = breakpoints_.last(wish, *run_, before, [&](double share) { return goesOn(watch, share); });
    goToStop(
        found,
        wish.text.empty() ? "No breakpoint was met before this tick" : "Before this tick it never held: " + wish.text,
        !goesOn(watch, 1));
}

void Debugger::runToBreak(BreakReach reach, const Watch& watch) {
    const bool within = reach == BreakReach::within;
    const std::int64_t from = run_->tick(), playedOut = playsTo();
    const Breakpoints::Answer known = breakpoints_.ahead(
        *run_, [&](double share) { return goesOn(watch, share); }, within ? std::optional(playedOut) : std::nullopt);
    const bool ended = !goesOn(watch, 1);
    if (!known || *known || ended) return goToStop(known, {}, ended);
    if (auto done = run_->seek(within ? playedOut : run_->last()); !done) return stop(done.error().message());
    const ScenarioParts& parts = run_->setup().scenario->parts();
    const std::int64_t length = std::max<std::int64_t>(1, parts.scene.ticksOf(parts.duration));
    const bool beyond = !within && run_->tick() >= playedOut;
    simulateToBreak(beyond ? (run_->tick() / length + 1) * length : playedOut, watch);
    if (!within || atBreak_) return;
    if (event_ == RunEvent::noBreak) stop("No break in the rest of this run");
    if (auto back = run_->seek(from); !back) stop(back.error().message());
}

Expected<void> Debugger::simulateToEnd(const Watch& watch) {
    const std::int64_t end = std::max(run_->last(), usualEnd(*run_));
    Expected<void> done = run_->seek(end);
    while (done && run_->tick() < end) {
        done = run_->forward();
        if (run_->tick() % askedEvery == 0 && !goesOn(watch, shareOf(run_->tick(), end))) break;
    }
    return done;
}

/// From the last tick on.
void Debugger::simulateToBreak(std::int64_t end, const Watch& watch) {
    const std::int64_t begin = run_->tick();
    while (run_->tick() < end) {
        breakpoints_.leave(*run_);
        if (auto done = run_->forward(); !done) return stop(done.error().message());
        const double share = shareOf(run_->tick() - begin, end - begin);
        if (stopsHere([&](double) { return goesOn(watch, share); })) {
            if (waits()) stop(endedEarly);
            return;
        }
        if (run_->tick() % askedEvery != 0) continue;
        if (!goesOn(watch, share)) return stop(endedEarly);
        if (watch.between) watch.between();
    }
    event_ = RunEvent::noBreak;
    stop("No break up to " + secondsText(run_->setup().scene().timeOf(run_->tick()), 0) + " s; it can go on");
}

Shown Debugger::takeShown(const FrameOptions& options) {
    Shown what = shownOf(*run_, options);
    std::size_t known = 0;  // marks of branches never grow but at their ends
    for (std::uint32_t i = 0; i < run_->branches().size(); ++i) known += run_->branches().record(i).marks().size();
    const bool others = !happened_ || marksOf_ != run_->branch() || marksKnown_ != known;
    if (others) happened_ = std::make_shared<const std::vector<TimelineMark>>(run_->branches().marks(run_->branch()));
    if (!marks_ || others || marksBreaks_ != breakpoints_.version()) {
        const std::vector<TimelineMark> hits = breakpoints_.marks(*run_);
        std::vector<TimelineMark> all;
        std::merge(happened_->begin(), happened_->end(), hits.begin(), hits.end(), std::back_inserter(all),
                   [](const TimelineMark& a, const TimelineMark& b) { return a.tick < b.tick; });
        marks_ = hits.empty() ? happened_ : std::make_shared<const std::vector<TimelineMark>>(std::move(all));
    }
    marksOf_ = run_->branch();
    marksKnown_ = known;
    marksBreaks_ = breakpoints_.version();
    what.marks = marks_;
    what.breakpoints = breakpoints_.states(*run_, *happened_);
    what.canDiverge = breakpoints_.canDiverge();
    what.atBreak = atBreak_;
    what.event = std::exchange(event_, RunEvent::none);
    what.playing = playing_;
    what.subject = std::exchange(subject_, std::nullopt);
    what.goal = goal_;
    what.message = message_;
    return what;
}

}  // namespace mrose
