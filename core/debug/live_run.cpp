#include "debug/live_run.h"

#include <utility>

namespace mrose {
namespace {

using namespace std::chrono_literals;

constexpr auto measuredOver = 500ms;
/// Who falls behind by more than this does not catch up later.
constexpr auto mostBehind = 100ms;

}  // namespace

void LiveRun::open(const OpenedRun& run) {
    stopRecording();
    debugger_.open(run);
    factor_ = 0;
    learning_ = true;
    learningBreaks_ = false;
}

bool LiveRun::turn(bool changed, const Progress& goesOn) {
    if (!debugger_.isOpen()) return changed;
    if (debugger_.playing()) changed = playTicks(goesOn) || changed;
    if (learning_) changed = learn() || changed;
    learningBreaks_ = changed || learningBreaks_;
    if (learningBreaks_ && !debugger_.playing() && !learning_) changed = learnBreaks() || changed;
    if (changed || recording_) followRecording();
    return changed;
}

void LiveRun::giveUp() {
    debugger_.stop();
    learning_ = learningBreaks_ = recording_ = false;
}

void LiveRun::setSpeed(double speed) {
    speed_ = speed;
    anchor();
}

void LiveRun::anchor() {
    anchor_ = measured_ = {Clock::now(), debugger_.isOpen() ? debugger_.run().tick() : 0};
    factor_ = 0;
}

/// As many ticks as are due, for one frame's time at the most; whether there were any.
bool LiveRun::playTicks(const Progress& goesOn) {
    const auto begin = Clock::now();
    const TimeTravel& run = debugger_.run();
    const Nanoseconds tickLength = run.setup().scene().tickLength;
    const auto due = [&](std::int64_t tick) {
        const double wait = speed_ > 0 ? static_cast<double>((tick - anchor_.tick) * tickLength) / speed_ : 0;
        return anchor_.time + std::chrono::nanoseconds(static_cast<std::int64_t>(wait));
    };
    const auto isDue = [&] { return due(run.tick() + 1) <= Clock::now() && Clock::now() - begin < framePeriod; };
    bool any = debugger_.waits();
    if (any) debugger_.playOn(goesOn);
    while (debugger_.playing() && !debugger_.waits() && isDue()) {
        debugger_.playOn(goesOn);
        any = true;
    }
    const auto now = Clock::now();
    if (speed_ > 0 && now - due(run.tick()) > mostBehind) anchor_ = {now, run.tick()};
    if (now - measured_.time >= measuredOver) {
        const double took = std::chrono::duration<double>(now - measured_.time).count();
        factor_ = toSeconds((run.tick() - measured_.tick) * tickLength) / took;
        measured_ = {now, run.tick()};
    }
    return any;
}

/// Looks through a file's ticks for a frame's time; whether there is something new to show.
bool LiveRun::learn() {
    const auto begin = Clock::now();
    const TimeTravel& run = debugger_.run();
    learning_ = false;
    bool any = false;
    do {
        const std::size_t marks = run.branches().record(run.branch()).marks().size();
        const auto more = debugger_.run().branches().learn(50);
        if (!more) return debugger_.say(more.error().message()), true;
        any = any || *more || marks != run.branches().record(run.branch()).marks().size();
        learning_ = *more;
    } while (learning_ && Clock::now() - begin < framePeriod);
    return any;
}

/// Some ticks more, for half a frame's time; whether there is something new to show.
bool LiveRun::learnBreaks() {
    const auto begin = Clock::now();
    bool any = false;
    do {
        const auto more = debugger_.learnBreaks();
        learningBreaks_ = more && *more;
        if (!more) debugger_.say(more.error().message());
        any = any || learningBreaks_ || !more;
    } while (learningBreaks_ && Clock::now() - begin < framePeriod / 2);
    return any;
}

Expected<void> LiveRun::record(const std::filesystem::path& path, const std::string& commandLine, bool overwrite) {
    stopRecording();
    auto recorder = RunRecorder::begin(path, debugger_.run(), commandLine, overwrite);
    if (!recorder) return tl::unexpected(recorder.error());
    recorder_.emplace(std::move(*recorder));
    nextFlush_ = Clock::now();
    return {};
}

void LiveRun::followRecording() {
    if (!recorder_) return;
    const auto begin = Clock::now();
    do {
        const auto more = recorder_->follow(debugger_.run(), 20);
        if (!more) return endRecording(tl::unexpected(more.error()));
        recording_ = *more;
    } while (recording_ && Clock::now() - begin < framePeriod);
    if (Clock::now() < nextFlush_) {
        recording_ = true;  // comes back for that
        return;
    }
    if (const auto flushed = recorder_->flush(); !flushed) return endRecording(flushed);
    nextFlush_ = Clock::now() + 1s;
}

void LiveRun::stopRecording() {
    if (recorder_) endRecording(recorder_->finish(debugger_.run()));
}

void LiveRun::endRecording(const Expected<void>& written) {
    recorder_.reset();
    recording_ = false;
    recordingEnded_(written);
}

}  // namespace mrose
