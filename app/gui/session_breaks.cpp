// What a session does with breakpoints.
#include <algorithm>
#include <chrono>

#include "session.h"

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

void Session::setDivergence(TickPredicate diverged) {
    request([this, diverged = std::move(diverged)] { breakpoints_.setDivergence(diverged); });
}

/// Playing or on its way, the run has come to another tick: whether it is to stop there.
bool Session::stopsHere() {
    const auto why = breakpoints_.arrive(*run_);
    if (why) stop(QString::fromStdString(*why));
    atBreak_ = why.has_value();
    return atBreak_;
}

void Session::goToStop(const Breakpoints::Answer& answer, const QString& none) {
    if (!answer) return stop(QString::fromStdString(answer.error().message()));
    if (!*answer) return stop(cancelled_ ? tr("Ended before a break was found") : none);
    if (auto done = run_->seek((*answer)->tick); !done) return stop(QString::fromStdString(done.error().message()));
    stop(QString::fromStdString(breakpoints_.stopped(*run_, **answer)));
    atBreak_ = true;
}

void Session::backToBreak() {
    request([this] {
        if (!run_) return;
        const QString what = tr("Looking for the last break");
        stop(QString());
        cancelled_ = false;
        emit working(what, 0);
        goToStop(breakpoints_.back(*run_, progressOf(what)), tr("No breakpoint was met before this tick"));
        emit working(what, 1);
        anchor();
    });
}

void Session::backToLast(const QString& text) {
    request([this, text] {
        if (!run_) return;
        const QString what = tr("Looking for when it last held: %1").arg(text);
        stop(QString());
        cancelled_ = false;
        emit working(what, 0);
        const Breakpoints::Answer answer = breakpoints_.last(*run_, text.toStdString(), progressOf(what));
        goToStop(answer, tr("Before this tick it never held: %1").arg(text));
        emit working(what, 1);
        anchor();
    });
}

void Session::runToBreak() {
    request([this] {
        if (!run_) return;
        const QString what = tr("Running to the next break");
        stop(QString());
        cancelled_ = false;
        emit working(what, 0);
        const Progress progress = progressOf(what);
        const Breakpoints::Answer known = breakpoints_.ahead(*run_, progress);
        if (!known || *known || cancelled_)
            goToStop(known, {});
        else if (auto done = run_->seek(run_->last()); !done)
            stop(QString::fromStdString(done.error().message()));
        else
            simulateToBreak(progress);
        emit working(what, 1);
        anchor();
    });
}

/// From the last tick on, up to where playing ends; from there on for as long again.
void Session::simulateToBreak(const Progress& progress) {
    const ScenarioParts& parts = run_->course().scenario->parts();
    const std::int64_t length = std::max<std::int64_t>(1, parts.scene.ticksOf(parts.duration));
    std::int64_t end = end_.value_or(length);
    if (run_->tick() >= end) end = (run_->tick() / length + 1) * length;
    const std::int64_t begin = run_->tick();
    auto shownAt = BreakClock::now();
    while (run_->tick() < end) {
        breakpoints_.leave(*run_);
        if (auto done = run_->forward(); !done) return stop(QString::fromStdString(done.error().message()));
        if (stopsHere()) return;
        if (run_->tick() % 16 != 0) continue;
        const double share = static_cast<double>(run_->tick() - begin) / static_cast<double>(end - begin);
        if (!progress(share)) return stop(tr("Ended before a break was found"));
        if (BreakClock::now() - shownAt < breakFrame) continue;
        serveLooks();
        if (recorder_) followRecording();
        publish();
        shownAt = BreakClock::now();
    }
    stop(tr("No break up to %1 s; it can go on").arg(toSeconds(parts.scene.timeOf(run_->tick())), 0, 'g', 6));
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
