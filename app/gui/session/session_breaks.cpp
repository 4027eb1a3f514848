// What a session does with breakpoints.
#include <algorithm>
#include <chrono>

#include "debug/play_end.h"
#include "session/session.h"

namespace mrose::gui {
namespace {

using BreakClock = std::chrono::steady_clock;
constexpr auto breakFrame = std::chrono::milliseconds(17);

}  // namespace

void Session::setBreakpoints(const std::vector<Breakpoint>& breakpoints) {
    request([this, breakpoints] { breakpoints_.replace(breakpoints); });
}

void Session::addBreakpoint(const Breakpoint& breakpoint) {
    request([this, breakpoint] { breakpoints_.add(breakpoint); });
}

void Session::changeBreakpoint(const Breakpoint& breakpoint) {
    request([this, breakpoint] { breakpoints_.change(breakpoint); });
}

void Session::removeBreakpoint(std::uint32_t id) {
    request([this, id] { breakpoints_.remove(id); });
}

void Session::enableBreakpoints(bool enabled) {
    request([this, enabled] { breakpoints_.enableAll(enabled); });
}

void Session::setDivergence(Breakpoints::DivergenceQuestion diverged) {
    request([this, diverged = std::move(diverged)] { breakpoints_.setDivergence(diverged); });
}

/// Playing or on its way, the run has come to another tick: whether it is to stand there, if only until it is known
/// whether it is to stop.
bool Session::stopsHere(const Progress& goesOn) {
    const auto arrival = breakpoints_.arrive(*run_, goesOn);
    counting_.reset();
    atBreak_ = false;
    if (!arrival) return stop(QString::fromStdString(arrival.error().message())), true;
    if (!arrival->known) counting_.emplace(run_->branch(), run_->tick());
    if (arrival->why) stop(QString::fromStdString(*arrival->why));
    atBreak_ = arrival->why.has_value();
    if (atBreak_) event_ = RunEvent::broke;
    return atBreak_ || !arrival->known;
}

bool Session::countsHere() const { return counting_ == std::pair(run_->branch(), run_->tick()); }

void Session::goToStop(const Breakpoints::Answer& answer, const QString& none) {
    if (!answer) return stop(QString::fromStdString(answer.error().message()));
    if (ended()) return stop(tr("Ended before a break was found"));
    if (!*answer) {
        event_ = RunEvent::noBreak;
        return stop(none);
    }
    if (auto done = run_->seek((*answer)->tick); !done) return stop(QString::fromStdString(done.error().message()));
    stop(QString::fromStdString(breakpoints_.stopped(*run_, **answer)));
    atBreak_ = true;
    event_ = RunEvent::broke;
}

void Session::setHitsInOtherRuns(const HitsInOtherRuns& met) {
    request([this, met] { breakpoints_.setHitsInOtherRuns(met); });
}

void Session::goToBreak(const BreakWish& wish, BreakReach reach) {
    const QString what = !wish.back          ? tr("Running to the next break")
                         : wish.text.empty() ? tr("Looking for the last break")
                                             : tr("Looking for when it last held: %1").arg(wish.text.c_str());
    request(
        [this, wish, reach, what] {
            if (!run_) return;
            stop(QString());
            emit working(what, 0);
            if (wish.back)
                backToBreak(wish, reach, progressOf(what));
            else
                runToBreak(reach, progressOf(what));
            emit working(what, 1);
            anchor();
        },
        Kind::lasting);
}

void Session::backToBreak(const BreakWish& wish, BreakReach reach, const Progress& progress) {
    const bool fromEnd = reach == BreakReach::all;
    if (fromEnd)
        if (auto done = simulateToEnd(progress); !done) return stop(QString::fromStdString(done.error().message()));
    const std::int64_t before = run_->tick() + (fromEnd ? 1 : 0);
    goToStop(breakpoints_.last(wish, *run_, before, progress),
             wish.text.empty() ? tr("No breakpoint was met before this tick")
                               : tr("Before this tick it never held: %1").arg(wish.text.c_str()));
}

void Session::runToBreak(BreakReach reach, const Progress& progress) {
    const bool within = reach == BreakReach::within;
    const std::int64_t from = run_->tick(), playedOut = end_.value_or(usualEnd(*run_));
    const Breakpoints::Answer known =
        breakpoints_.ahead(*run_, progress, within ? std::optional(playedOut) : std::nullopt);
    if (!known || *known || ended()) return goToStop(known, {});
    if (auto done = run_->seek(within ? playedOut : run_->last()); !done)
        return stop(QString::fromStdString(done.error().message()));
    const ScenarioParts& parts = run_->setup().scenario->parts();
    const std::int64_t length = std::max<std::int64_t>(1, parts.scene.ticksOf(parts.duration));
    const bool beyond = !within && run_->tick() >= playedOut;
    simulateToBreak(beyond ? (run_->tick() / length + 1) * length : playedOut, progress);
    if (!within || atBreak_) return;
    if (event_ == RunEvent::noBreak) stop(tr("No break in the rest of this run"));
    if (auto back = run_->seek(from); !back) stop(QString::fromStdString(back.error().message()));
}

Expected<void> Session::simulateToEnd(const Progress& progress) {
    const std::int64_t end = std::max(run_->last(), usualEnd(*run_));
    Expected<void> done = run_->seek(end);
    while (done && run_->tick() < end) {
        done = run_->forward();
        if (run_->tick() % 16 == 0 && !progress(static_cast<double>(run_->tick()) / static_cast<double>(end))) break;
    }
    return done;
}

/// From the last tick on.
void Session::simulateToBreak(std::int64_t end, const Progress& progress) {
    const std::int64_t begin = run_->tick();
    auto shownAt = BreakClock::now();
    while (run_->tick() < end) {
        breakpoints_.leave(*run_);
        if (auto done = run_->forward(); !done) return stop(QString::fromStdString(done.error().message()));
        const double share = static_cast<double>(run_->tick() - begin) / static_cast<double>(end - begin);
        if (stopsHere([&](double) { return progress(share); })) {
            if (countsHere()) stop(tr("Ended before a break was found"));
            return;
        }
        if (run_->tick() % 16 != 0) continue;
        if (!progress(share)) return stop(tr("Ended before a break was found"));
        if (BreakClock::now() - shownAt < breakFrame) continue;
        serveLooks();
        if (recorder_) followRecording();
        publish();
        shownAt = BreakClock::now();
    }
    event_ = RunEvent::noBreak;
    stop(tr("No break up to %1 s; it can go on").arg(toSeconds(run_->setup().scene().timeOf(run_->tick())), 0, 'g', 6));
}

/// Some ticks more, for half a frame's time; whether there is something new to show.
bool Session::learnBreaks() {
    const auto begin = BreakClock::now();
    bool any = false;
    do {
        const auto more = breakpoints_.learn(*run_);
        judging_ = more && *more;
        if (!more) message_ = QString::fromStdString(more.error().message());
        any = any || judging_ || !more;
    } while (judging_ && BreakClock::now() - begin < breakFrame / 2);
    return any;
}

}  // namespace mrose::gui
