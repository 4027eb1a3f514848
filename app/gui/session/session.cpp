#include "session/session.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "debug/play_end.h"
#include "io/caught.h"

namespace mrose::gui {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto framePeriod = std::chrono::microseconds(16'667);
constexpr auto measuredOver = std::chrono::milliseconds(500);
/// Who falls behind by more than this does not catch up later.
constexpr auto mostBehind = std::chrono::milliseconds(100);

QString secondsText(const TimeTravel& run, std::int64_t tick) {
    return QString::number(toSeconds(run.setup().scene().timeOf(tick)), 'f', 2);
}

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
    const std::uint64_t number = ++opened_;
    request([this, run, number] {
        if (recorder_) endRecording(recorder_->finish(*run_));
        run_.emplace(run);
        runNumber_ = number;
        stop(QString());
        event_ = RunEvent::none;
        end_.reset();
        goal_.reset();
        subject_.reset();
        counting_.reset();
        breakpoints_.forgetRun();
        learning_ = true;
        judging_ = false;
        marks_.reset();
        happened_.reset();
    });
    return number;
}

void Session::play() {
    request([this] {
        if (!run_) return;
        message_.clear();
        playing_ = true;
        anchor();
    });
}

void Session::pause() {
    request([this] { stop(QString()); });
}

void Session::setSpeed(double speed) {
    request([this, speed] {
        speed_ = speed;
        anchor();
    });
}

void Session::stopAt(std::int64_t tick) {
    request([this, tick] { end_ = tick; });
}

void Session::stepBy(std::int64_t ticks) {
    request([this, ticks] {
        if (!run_) return;
        stop(QString());
        Expected<void> done;
        if (ticks < 0)
            done = run_->seek(run_->tick() + ticks);
        else
            for (std::int64_t i = 0; i < ticks && done; ++i) done = run_->forward();
        if (!done) message_ = QString::fromStdString(done.error().message());
    });
}

void Session::seek(std::int64_t tick, bool breaks) {
    request(
        [this, tick, breaks] {
            if (run_) goTo(tick, breaks);
        },
        Kind::seek);
}

void Session::show(std::uint32_t branch, std::int64_t tick) {
    request([this, branch, tick] {
        if (!run_ || branch >= run_->branches().size()) return;
        message_.clear();
        if (auto done = run_->show(branch, tick); !done)
            message_ = QString::fromStdString(done.error().message());
        else if (run_->tick() != tick)
            message_ = tr("This branch has not come to %1 s: it is shown at %2 s, the nearest that it has")
                           .arg(secondsText(*run_, tick), secondsText(*run_, run_->tick()));
        anchor();
    });
}

void Session::branchOff(const Edit& edit, std::optional<std::int64_t> seek, std::function<void()> begun) {
    const auto branch = [this, edit, seek, begun = std::move(begun)] {
        if (!run_) return;
        stop(QString());
        if (auto done = run_->branchOff(edit); !done) {
            message_ = QString::fromStdString(done.error().message());
            return;
        }
        if (begun) begun();
        if (seek) goTo(*seek, false);
        if (message_.isEmpty())
            message_ = run_->edited() ? tr("This branch now begins with \u201c%1\u201d: Space plays it, S shows both "
                                           "branches side by side")
                                            .arg(QString::fromStdString(run_->branches()[run_->branch()].name))
                                      : tr("A branch begins here: Space plays it, S shows both branches side by side");
    };
    request(branch, seek ? Kind::lasting : Kind::quick);
}

void Session::showBeside(std::optional<std::uint32_t> branch) {
    request([this, branch] {
        if (run_) run_->setBeside(branch);
    });
}

Session::Progress Session::progressOf(const QString& what, bool finishes) {
    return [this, what, finishes, reportedAt = Clock::now()](double share) mutable {
        if (Clock::now() - reportedAt >= 2 * framePeriod) {
            emit working(what, share);
            reportedAt = Clock::now();
        }
        return finishes ? !cancelled() : !ended();
    };
}

void Session::doLongWork(const QString& what, std::function<QString(TimeTravel&, const Progress&)> job, bool finishes) {
    request(
        [this, what, job = std::move(job), finishes] {
            if (!run_) return;
            emit working(what, 0);
            message_ = job(*run_, progressOf(what, finishes));
            emit working(what, 1);
            anchor();
        },
        Kind::lasting);
}

void Session::record(const QString& path, const QString& commandLine, bool overwrite) {
    request([this, path, commandLine, overwrite] {
        if (!run_) return;
        if (recorder_) endRecording(recorder_->finish(*run_));
        auto recorder = RunRecorder::begin(path.toStdString(), *run_, commandLine.toStdString(), overwrite);
        if (!recorder) {
            emit recordingChanged({}, QString::fromStdString(recorder.error().message()));
            return;
        }
        recorder_.emplace(std::move(*recorder));
        nextFlush_ = Clock::now();
        emit recordingChanged(path, {});
    });
}

void Session::stopRecording() {
    request([this] {
        if (recorder_) endRecording(recorder_->finish(*run_));
    });
}

/// The run goes on, whatever becomes of its file.
void Session::endRecording(const Expected<void>& done) {
    recorder_.reset();
    recording_ = false;
    emit recordingChanged({}, done ? QString() : QString::fromStdString(done.error().message()));
}

/// For a frame's time.
void Session::followRecording() {
    const auto begin = Clock::now();
    do {
        const auto more = recorder_->follow(*run_, 20);
        if (!more) return endRecording(tl::unexpected(more.error()));
        recording_ = *more;
    } while (recording_ && Clock::now() - begin < framePeriod);
    if (Clock::now() < nextFlush_) {
        recording_ = true;  // comes back for that
        return;
    }
    if (const auto flushed = recorder_->flush(); !flushed) return endRecording(flushed);
    nextFlush_ = Clock::now() + std::chrono::seconds(1);
}

bool Session::cancel() {
    const std::lock_guard lock(mutex_);
    if (lasting_ == 0) return false;
    ++cancels_;
    return true;
}

void Session::showCauseOfKick() {
    request([this] {
        if (!run_) return;
        const auto cause = run_->causeOfKick();
        stop(cause ? QString() : tr("No kick up to here: let it play, or go to a kick on the timeline"));
        if (!cause) return;
        // The state after the decision is the first that shows it.
        if (auto done = run_->seek(cause->order.tick + 1); !done) {
            message_ = QString::fromStdString(done.error().message());
            return;
        }
        const Scene& scene = run_->setup().scene();
        const SceneRobot& robot = scene.robots[cause->order.robot];
        message_ = tr("%1 decided here to kick; the kick of %2 s is its work. E changes what it decided")
                       .arg(QString::fromStdString(robot.name), secondsText(*run_, cause->kicked));
        subject_ = cause->order.robot;
    });
}

void Session::rename(std::uint32_t branch, const QString& name) {
    request([this, branch, name = name.toStdString()] {
        if (run_ && branch < run_->branches().size()) run_->rename(branch, name);
    });
}

void Session::undo() {
    request([this] {
        if (!run_) return;
        const QString what = QString::fromStdString(run_->undoName());
        if (run_->undo())
            stop(tr("Undone: %1. The branch stays in the list; %2 s is shown as it was before")
                     .arg(what, secondsText(*run_, run_->tick())));
    });
}

void Session::redo() {
    request([this] {
        if (!run_) return;
        const QString what = QString::fromStdString(run_->redoName());
        if (run_->redo()) stop(tr("Done again: %1").arg(what));
    });
}

void Session::setReality(std::uint64_t run, std::shared_ptr<const Reality> reality) {
    request([this, run, reality = std::move(reality)] {
        if (!run_ || run != runNumber_) return;
        if (!isSameTruth(run_->reality(), reality)) breakpoints_.forgetAnswers();
        run_->setReality(reality);
    });
}

void Session::setFrameOptions(const TimeTravel::FrameOptions& options) {
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
        const auto done = caught([&] { look(run_ && !quit_ ? &*run_ : nullptr, runNumber_); });
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
            if (playing_ || learning_ || recording_ || judging_)
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
        if (run_ && changed.value_or(true))
            if (const auto shown = caught([this] { publish(); }); !shown) giveUp(shown.error());
        nextFrame = std::max(Clock::now(), nextFrame + framePeriod);
        lock.lock();
    }
    lock.unlock();
    serveLooks();
    if (!recorder_) return;
    // No receiver is left for signals.
    const auto done = caught([this] { return recorder_->finish(*run_); });
    if (!done) qWarning("%s", done.error().message().c_str());
}

/// What is due besides what was asked for; whether there is something new to show.
bool Session::turn(bool changed) {
    if (playing_) changed = playTicks() || changed;
    if (learning_ && run_) changed = learn() || changed;
    judging_ = run_ && (changed || judging_);
    if (judging_ && !playing_ && !learning_) changed = learnBreaks() || changed;
    if (recorder_ && (changed || recording_)) followRecording();
    return changed;
}

/// What cannot be gone on with is not tried again.
void Session::giveUp(const Error& error) {
    stop(QString());
    learning_ = judging_ = recording_ = false;
    counting_.reset();
    goal_.reset();
    emit working({}, 1);
    reportFailure(error);
}

void Session::reportFailure(const Error& error) { emit failed(QString::fromStdString(error.message())); }

bool Session::superseded() {
    const std::lock_guard lock(mutex_);
    return quit_ || !requests_.empty();
}

/// To a tick that has been, or by simulating up to one that has not; whatever is asked for meanwhile ends that.
void Session::goTo(std::int64_t tick, bool breaks) {
    if (ended()) return;
    message_.clear();
    atBreak_ = false;
    counting_.reset();
    Expected<void> done = run_->seek(tick);
    const auto goesOn = [this](double) { return !superseded() && !ended(); };
    auto shownAt = Clock::now();
    while (done && run_->tick() < tick) {
        if (breaks) breakpoints_.leave(*run_);
        done = run_->forward();
        if (done && breaks && stopsHere(goesOn)) break;
        if (run_->tick() % 16 != 0) continue;
        if (!goesOn(0)) break;
        if (Clock::now() - shownAt < framePeriod) continue;
        serveLooks();
        goal_ = tick;
        if (recorder_) followRecording();
        publish();
        shownAt = Clock::now();
    }
    goal_.reset();
    if (!done) message_ = QString::fromStdString(done.error().message());
    anchor();
}

void Session::anchor() {
    anchor_ = measuredAt_ = Clock::now();
    anchorTick_ = measuredTick_ = run_ ? run_->tick() : 0;
    factor_ = 0;
}

/// Looks through a file's ticks for a frame's time; whether there is something new to show.
bool Session::learn() {
    const auto begin = Clock::now();
    learning_ = false;
    bool any = false;
    while (Clock::now() - begin < framePeriod) {
        const std::size_t marks = run_->record(run_->branch()).marks().size();
        const auto more = run_->learn(50);
        if (!more) {
            message_ = QString::fromStdString(more.error().message());
            return true;
        }
        any = any || *more || marks != run_->record(run_->branch()).marks().size();
        learning_ = *more;
        if (!*more) break;
    }
    return any;
}

/// As many ticks as are due, for one frame's time at the most; whether there were any.
bool Session::playTicks() {
    const auto begin = Clock::now();
    const Nanoseconds tickLength = run_->setup().scene().tickLength;
    const auto due = [&](std::int64_t tick) {
        const double wait = speed_ > 0 ? static_cast<double>((tick - anchorTick_) * tickLength) / speed_ : 0;
        return anchor_ + std::chrono::nanoseconds(static_cast<std::int64_t>(wait));
    };
    const auto arrive = [this] {
        if (stopsHere([this](double) { return !superseded(); })) return;
        if (run_->tick() != end_.value_or(usualEnd(*run_))) return;
        stop(QString::fromStdString(endText(*run_)));
        event_ = RunEvent::playedOut;
    };
    bool any = countsHere();
    if (any) arrive();
    while (playing_ && !countsHere() && due(run_->tick() + 1) <= Clock::now() && Clock::now() - begin < framePeriod) {
        breakpoints_.leave(*run_);
        if (auto done = run_->forward(); !done) return stop(QString::fromStdString(done.error().message())), true;
        any = true;
        arrive();
    }
    const auto now = Clock::now();
    if (speed_ > 0 && now - due(run_->tick()) > mostBehind) {
        anchor_ = now;
        anchorTick_ = run_->tick();
    }
    if (now - measuredAt_ >= measuredOver) {
        const double took = std::chrono::duration<double>(now - measuredAt_).count();
        factor_ = toSeconds((run_->tick() - measuredTick_) * tickLength) / took;
        measuredAt_ = now;
        measuredTick_ = run_->tick();
    }
    return any;
}

void Session::stop(const QString& why) {
    playing_ = false;
    factor_ = 0;
    atBreak_ = false;
    message_ = why;
}

}  // namespace mrose::gui
