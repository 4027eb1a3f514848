#include "session/session.h"

#include <algorithm>
#include <utility>

#include "io/caught.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

using namespace std::chrono_literals;

constexpr auto framePeriod = 16'667us;
constexpr auto measuredOver = 500ms;
/// Who falls behind by more than this does not catch up later.
constexpr auto mostBehind = 100ms;

}  // namespace

Session::Session(QObject* parent) : QObject(parent), worker_([this] { work(); }) {}

Session::~Session() { quit(); }

void Session::quit() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_all();
    if (worker_.joinable()) worker_.join();
}

void Session::request(std::function<void()> what, Kind kind) {
    {
        const std::lock_guard lock(mutex_);
        Request asked{std::move(what), kind, cancels_, opened_};
        if (kind == Kind::seek && !requests_.empty() && requests_.back().kind == Kind::seek) {
            requests_.back() = std::move(asked);
        } else {
            requests_.push_back(std::move(asked));
            lasting_ += kind == Kind::quick ? 0 : 1;
        }
    }
    wake_.notify_all();
}

void Session::carryOut(const Request& request) {
    cancelsBefore_ = request.cancels;
    openedBefore_ = request.opened;
    if (const auto done = caught(request.carryOut); !done) giveUp(done.error());
    if (request.kind == Kind::quick) return;
    const std::lock_guard lock(mutex_);
    --lasting_;
}

std::uint64_t Session::open(const OpenRun& run) {
    runName_ = run.name;
    emit opening(run);
    const std::uint64_t number = ++opened_;
    request([this, run, number] {
        if (recorder_) endRecording(recorder_->finish(debugger_.run()));
        debugger_.open(run);
        runNumber_ = number;
        factor_ = 0;
        learning_ = true;
        judging_ = false;
    });
    return number;
}

void Session::ask(std::function<void(Debugger&)> what, std::optional<std::uint64_t> ofRun) {
    request([this, what = std::move(what), ofRun] {
        if (!debugger_.isOpen() || (ofRun && *ofRun != runNumber_)) return;
        const std::pair before(debugger_.playing(), debugger_.run().tick());
        what(debugger_);
        if (before != std::pair(debugger_.playing(), debugger_.run().tick())) anchor();
    });
}

void Session::pause() {
    ask([](Debugger& debugger) { debugger.stop(); });
}

void Session::setSpeed(double speed) {
    request([this, speed] {
        speed_ = speed;
        anchor();
    });
}

void Session::seek(std::int64_t tick, bool breaks) {
    request(
        [this, tick, breaks] {
            if (debugger_.isOpen()) goTo(tick, breaks);
        },
        Kind::seek);
}

void Session::goTo(std::int64_t tick, bool breaks) {
    if (ended()) return;
    debugger_.goTo(tick, breaks, watch([this](double) { return !superseded() && !ended(); }));
    anchor();
}

void Session::branchOff(const Edit& edit, std::optional<std::int64_t> seek, std::function<void()> begun) {
    const auto branch = [this, edit, seek, begun = std::move(begun)] {
        if (!debugger_.isOpen() || !debugger_.branchOff(edit)) return;
        if (begun) begun();
        if (seek) goTo(*seek, false);
        debugger_.sayBranched();
    };
    request(branch, seek ? Kind::lasting : Kind::quick);
}

void Session::goToBreak(const BreakWish& wish, BreakReach reach) {
    const QString what = !wish.back          ? tr("Running to the next break")
                         : wish.text.empty() ? tr("Looking for the last break")
                                             : tr("Looking for when it last held: %1").arg(wish.text.c_str());
    request(
        [this, wish, reach, what] {
            if (!debugger_.isOpen()) return;
            emit working(what, 0);
            debugger_.goToBreak(wish, reach, watch(progressOf(what)));
            emit working(what, 1);
            anchor();
        },
        Kind::lasting);
}

Progress Session::progressOf(const QString& what, bool finishes) {
    return [this, what, finishes, reportedAt = Clock::now()](double share) mutable {
        if (Clock::now() - reportedAt >= 2 * framePeriod) {
            emit working(what, share);
            reportedAt = Clock::now();
        }
        return finishes ? !cancelled() : !ended();
    };
}

/// What is shown goes along, frame by frame.
Watch Session::watch(Progress goesOn) {
    return {std::move(goesOn), [this, shownAt = Clock::now()]() mutable {
                if (Clock::now() - shownAt < framePeriod) return;
                serveLooks();
                if (recorder_) followRecording();
                publish();
                shownAt = Clock::now();
            }};
}

void Session::doLongWork(const QString& what, std::function<void(TimeTravel&, const Progress&)> job, bool finishes) {
    request(
        [this, what, job = std::move(job), finishes] {
            if (!debugger_.isOpen()) return;
            emit working(what, 0);
            debugger_.say({});
            job(debugger_.run(), progressOf(what, finishes));
            emit working(what, 1);
            anchor();
        },
        Kind::lasting);
}

void Session::record(const QString& path, const QString& commandLine, bool overwrite) {
    request([this, path, commandLine, overwrite] {
        if (!debugger_.isOpen()) return;
        if (recorder_) endRecording(recorder_->finish(debugger_.run()));
        auto recorder = RunRecorder::begin(path.toStdString(), debugger_.run(), commandLine.toStdString(), overwrite);
        if (!recorder) {
            emit recordingChanged({}, qtText(recorder.error().message()));
            return;
        }
        recorder_.emplace(std::move(*recorder));
        nextFlush_ = Clock::now();
        emit recordingChanged(path, {});
    });
}

void Session::stopRecording() {
    request([this] {
        if (recorder_) endRecording(recorder_->finish(debugger_.run()));
    });
}

/// The run goes on, whatever becomes of its file.
void Session::endRecording(const Expected<void>& done) {
    recorder_.reset();
    recording_ = false;
    emit recordingChanged({}, done ? QString() : qtText(done.error().message()));
}

/// For a frame's time.
void Session::followRecording() {
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

bool Session::cancel() {
    const std::lock_guard lock(mutex_);
    if (lasting_ == 0) return false;
    ++cancels_;
    return true;
}

void Session::setFrameOptions(const FrameOptions& options) {
    request([this, options] { frameOptions_ = options; });
}

void Session::look(Look what) {
    {
        const std::lock_guard lock(mutex_);
        if (!quit_) {
            looks_.push_back(std::move(what));
            wake_.notify_all();
            return;
        }
    }
    what(nullptr, 0);
}

void Session::serveLooks() {
    std::deque<Look> looks;
    {
        const std::lock_guard lock(mutex_);
        looks.swap(looks_);
    }
    for (const Look& look : looks) {
        const auto done = caught([&] { look(debugger_.isOpen() && !quit_ ? &debugger_.run() : nullptr, runNumber_); });
        if (!done) reportFailure(done.error());
    }
}

bool Session::busy() {
    const std::lock_guard lock(mutex_);
    return busy_ || !requests_.empty();
}

void Session::settle() {
    std::unique_lock lock(mutex_);
    settled_.wait(lock, [this] { return requests_.empty() && !busy_; });
    lock.unlock();
    deliver();
}

void Session::work() {
    std::unique_lock lock(mutex_);
    auto nextFrame = Clock::now();
    while (!quit_) {
        if (requests_.empty()) {
            busy_ = false;
            settled_.notify_all();
            const auto called = [this] { return quit_ || !requests_.empty() || !looks_.empty(); };
            if (debugger_.playing() || learning_ || recording_ || judging_)
                wake_.wait_until(lock, nextFrame, called);
            else
                wake_.wait(lock, called);
            if (quit_) break;
        }
        if (!looks_.empty()) {
            lock.unlock();
            serveLooks();
            lock.lock();
            if (requests_.empty() && Clock::now() < nextFrame) continue;
        }
        busy_ = true;
        const std::deque<Request> requests = std::exchange(requests_, {});
        lock.unlock();
        for (const Request& request : requests) carryOut(request);
        auto changed = caught([&] { return turn(!requests.empty()); });
        if (!changed) giveUp(changed.error());
        if (debugger_.isOpen() && changed.value_or(true))
            if (const auto shown = caught([this] { publish(); }); !shown) giveUp(shown.error());
        nextFrame = std::max(Clock::now(), nextFrame + framePeriod);
        lock.lock();
    }
    lock.unlock();
    serveLooks();
    if (!recorder_) return;
    // No receiver is left for signals.
    const auto done = caught([this] { return recorder_->finish(debugger_.run()); });
    if (!done) qWarning("%s", done.error().message().c_str());
}

/// What is due besides what was asked for; whether there is something new to show.
bool Session::turn(bool changed) {
    if (!debugger_.isOpen()) return changed;
    if (debugger_.playing()) changed = playTicks() || changed;
    if (learning_) changed = learn() || changed;
    judging_ = changed || judging_;
    if (judging_ && !debugger_.playing() && !learning_) changed = judge() || changed;
    if (recorder_ && (changed || recording_)) followRecording();
    return changed;
}

/// What cannot be gone on with is not tried again.
void Session::giveUp(const Error& error) {
    debugger_.stop();
    learning_ = judging_ = recording_ = false;
    emit working({}, 1);
    reportFailure(error);
}

void Session::reportFailure(const Error& error) { emit failed(qtText(error.message())); }

bool Session::superseded() {
    const std::lock_guard lock(mutex_);
    return quit_ || !requests_.empty();
}

void Session::anchor() {
    anchor_ = measured_ = {Clock::now(), debugger_.isOpen() ? debugger_.run().tick() : 0};
    factor_ = 0;
}

/// Looks through a file's ticks for a frame's time; whether there is something new to show.
bool Session::learn() {
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
bool Session::judge() {
    const auto begin = Clock::now();
    bool any = false;
    do {
        const auto more = debugger_.judge();
        judging_ = more && *more;
        if (!more) debugger_.say(more.error().message());
        any = any || judging_ || !more;
    } while (judging_ && Clock::now() - begin < framePeriod / 2);
    return any;
}

/// As many ticks as are due, for one frame's time at the most; whether there were any.
bool Session::playTicks() {
    const auto begin = Clock::now();
    const TimeTravel& run = debugger_.run();
    const Nanoseconds tickLength = run.setup().scene().tickLength;
    const auto due = [&](std::int64_t tick) {
        const double wait = speed_ > 0 ? static_cast<double>((tick - anchor_.tick) * tickLength) / speed_ : 0;
        return anchor_.time + std::chrono::nanoseconds(static_cast<std::int64_t>(wait));
    };
    const auto isDue = [&] { return due(run.tick() + 1) <= Clock::now() && Clock::now() - begin < framePeriod; };
    const auto play = [this] { debugger_.playOn([this](double) { return !superseded(); }); };
    bool any = debugger_.waits();
    if (any) play();
    while (debugger_.playing() && !debugger_.waits() && isDue()) {
        play();
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

void Session::publish() {
    auto what = std::make_shared<Shown>(debugger_.takeShown(frameOptions_));
    what->run = runNumber_;
    what->realTimeFactor = what->playing ? factor_ : 0;
    const std::lock_guard lock(mutex_);
    // What has not been shown yet must not get lost.
    if (ready_ && !what->subject) what->subject = ready_->subject;
    if (ready_ && ready_->run == what->run && what->event == RunEvent::none) what->event = ready_->event;
    ready_ = std::move(what);
    if (std::exchange(deliveryPending_, true)) return;
    QMetaObject::invokeMethod(this, &Session::deliver, Qt::QueuedConnection);
}

void Session::deliver() {
    std::shared_ptr<const Shown> what;
    {
        const std::lock_guard lock(mutex_);
        deliveryPending_ = false;
        what = std::exchange(ready_, nullptr);
    }
    if (!what) return;
    current_ = what;
    emit shown(std::move(what));
}

}  // namespace mrose::gui
