#include "session.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace mrose::gui {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto framePeriod = std::chrono::microseconds(16'667);
constexpr auto measuredOver = std::chrono::milliseconds(500);
/// Who falls behind by more than this does not catch up later.
constexpr auto mostBehind = std::chrono::milliseconds(100);

using Marks = std::shared_ptr<const std::vector<TimelineMark>>;

Marks withHits(const Marks& happened, const std::vector<TimelineMark>& hits) {
    if (hits.empty()) return happened;
    std::vector<TimelineMark> all;
    std::merge(happened->begin(), happened->end(), hits.begin(), hits.end(), std::back_inserter(all),
               [](const TimelineMark& a, const TimelineMark& b) { return a.tick < b.tick; });
    return std::make_shared<const std::vector<TimelineMark>>(std::move(all));
}

QString secondsText(const TimeTravel& run, std::int64_t tick) {
    return QString::number(toSeconds(run.course().scene().timeOf(tick)), 'f', 2);
}

}  // namespace

Session::Session(QObject* parent) : QObject(parent), worker_([this] { work(); }) {}

Session::~Session() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_all();
    worker_.join();
}

void Session::request(Request what) {
    {
        const std::lock_guard lock(mutex_);
        requests_.push_back(std::move(what));
    }
    wake_.notify_all();
}

void Session::open(const OpenRun& run) {
    request([this, run] {
        if (recorder_) endRecording(recorder_->finish(*run_));
        run_.emplace(run);
        end_.reset();
        breakpoints_.forgetRun();
        ++runs_;
        learning_ = true;
        marks_.reset();
        happened_.reset();
        message_.clear();
        playing_ = false;
    });
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
    {
        const std::lock_guard lock(mutex_);
        seekTo_ = tick;
        seekBreaks_ = breaks;
    }
    wake_.notify_all();
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

void Session::branchOff(const Edit& edit, std::optional<std::int64_t> seek) {
    request([this, edit, seek] {
        if (!run_) return;
        stop(QString());
        if (auto done = run_->branchOff(edit); !done) {
            message_ = QString::fromStdString(done.error().message());
            return;
        }
        if (seek) goTo(*seek, false);
        if (message_.isEmpty())
            message_ = tr("A branch begins here: Space plays it, S shows both courses side by side");
    });
}

void Session::showBeside(std::optional<std::uint32_t> branch) {
    request([this, branch] {
        if (run_) run_->setBeside(branch);
    });
}

Session::Progress Session::progressOf(const QString& what) {
    return [this, what, toldAt = Clock::now()](double share) mutable {
        if (Clock::now() - toldAt >= 2 * framePeriod) {
            emit working(what, share);
            toldAt = Clock::now();
        }
        return !cancelled_ && !quit_;
    };
}

void Session::run(const QString& what, std::function<QString(TimeTravel&, const Progress&)> job) {
    request([this, what, job = std::move(job)] {
        if (!run_) return;
        cancelled_ = false;
        emit working(what, 0);
        const QString said = job(*run_, progressOf(what));
        emit working(what, 1);
        message_ = said;
        anchor();
    });
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
    recorder_->flush();
    nextFlush_ = Clock::now() + std::chrono::seconds(1);
}

void Session::cancel() {
    cancelled_ = true;
    // Any request ends the way to a tick.
    request([] {});
}

void Session::showCauseOfKick() {
    request([this] {
        if (!run_) return;
        const auto cause = run_->causeOfKick();
        stop(cause ? QString() : tr("Nobody has kicked up to here: let it play, or go to a kick on the timeline"));
        if (!cause) return;
        // The state after the decision is the first that shows it.
        if (auto done = run_->seek(cause->order.tick + 1); !done) {
            message_ = QString::fromStdString(done.error().message());
            return;
        }
        const Scene& scene = run_->course().scene();
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
        if (run_ && run_->undo()) stop(QString());
    });
}

void Session::redo() {
    request([this] {
        if (run_ && run_->redo()) stop(QString());
    });
}

void Session::setReality(std::uint64_t run, std::shared_ptr<const Reality> reality) {
    request([this, run, reality = std::move(reality)] {
        if (run_ && run == runs_) run_->setReality(reality);
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
    for (const Look& look : looks) look(run_ && !quit_ ? &*run_ : nullptr, runs_);
}

bool Session::busy() {
    const std::lock_guard lock(mutex_);
    return busy_ || seekTo_ || !requests_.empty();
}

void Session::settle() {
    std::unique_lock lock(mutex_);
    settled_.wait(lock, [this] { return requests_.empty() && !seekTo_ && !busy_; });
    lock.unlock();
    deliver();
}

void Session::work() {
    std::unique_lock lock(mutex_);
    auto nextFrame = Clock::now();
    while (!quit_) {
        if (requests_.empty() && !seekTo_) {
            busy_ = false;
            settled_.notify_all();
            const auto called = [this] {
                return quit_ || !requests_.empty() || seekTo_.has_value() || !looks_.empty();
            };
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
            if (requests_.empty() && !seekTo_ && Clock::now() < nextFrame) continue;
        }
        busy_ = true;
        std::deque<Request> requests = std::exchange(requests_, {});
        const std::optional<std::int64_t> seekTo = std::exchange(seekTo_, std::nullopt);
        const bool breaks = seekBreaks_;
        lock.unlock();
        bool changed = !requests.empty() || seekTo;
        for (const Request& request : requests) request();
        if (seekTo && run_) goTo(*seekTo, breaks);
        if (playing_) changed = playTicks() || changed;
        if (learning_ && run_) changed = learn() || changed;
        judging_ = run_ && (changed || judging_);
        if (judging_ && !playing_ && !learning_) changed = learnBreaks() || changed;
        if (recorder_ && (changed || recording_)) followRecording();
        if (changed && run_) publish();
        nextFrame = std::max(Clock::now(), nextFrame + framePeriod);
        lock.lock();
    }
    lock.unlock();
    serveLooks();
    if (recorder_) endRecording(recorder_->finish(*run_));
}

bool Session::superseded() {
    const std::lock_guard lock(mutex_);
    return quit_ || seekTo_ || !requests_.empty();
}

/// To a tick that has been, or by simulating up to one that has not; whatever is asked for meanwhile ends that.
void Session::goTo(std::int64_t tick, bool breaks) {
    message_.clear();
    atBreak_ = false;
    Expected<void> done = run_->seek(tick);
    auto shownAt = Clock::now();
    while (done && run_->tick() < tick) {
        if (breaks) breakpoints_.leave(*run_);
        done = run_->forward();
        if (done && breaks && stopsHere()) break;
        if (run_->tick() % 16 != 0) continue;
        if (superseded()) break;
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
    const Nanoseconds tickLength = run_->course().scene().tickLength;
    const auto due = [&](std::int64_t tick) {
        const double wait = speed_ > 0 ? static_cast<double>((tick - anchorTick_) * tickLength) / speed_ : 0;
        return anchor_ + std::chrono::nanoseconds(static_cast<std::int64_t>(wait));
    };
    bool any = false;
    while (playing_ && due(run_->tick() + 1) <= Clock::now() && Clock::now() - begin < framePeriod) {
        breakpoints_.leave(*run_);
        if (auto done = run_->forward(); !done) return stop(QString::fromStdString(done.error().message())), true;
        any = true;
        stopsHere();
        const ScenarioParts& parts = run_->course().scenario->parts();
        if (playing_ && run_->tick() == end_.value_or(parts.scene.ticksOf(parts.duration)))
            stop(tr("%1 s are over; it can go on").arg(toSeconds(parts.scene.timeOf(run_->tick())), 0, 'g', 6));
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

void Session::publish() {
    auto what = std::make_shared<Shown>(shownOf(*run_, frameOptions_));
    what->run = runs_;
    what->goal = goal_;
    what->subject = std::exchange(subject_, std::nullopt);
    std::size_t known = 0;  // marks of branches never grow but at their ends
    for (std::uint32_t i = 0; i < run_->branches().size(); ++i) known += run_->record(i).marks().size();
    const bool others = !happened_ || marksOf_ != run_->branch() || marksKnown_ != known;
    if (others) happened_ = std::make_shared<const std::vector<TimelineMark>>(run_->marks());
    if (!marks_ || others || marksBreaks_ != breakpoints_.version())
        marks_ = withHits(happened_, breakpoints_.marks(*run_));
    marksOf_ = run_->branch();
    marksKnown_ = known;
    marksBreaks_ = breakpoints_.version();
    what->marks = marks_;
    what->breakpoints = breakpoints_.states(*run_, *happened_);
    what->atBreak = atBreak_;
    what->canDiverge = breakpoints_.canDiverge();
    what->playing = playing_;
    what->realTimeFactor = factor_;
    what->message = message_;
    const std::lock_guard lock(mutex_);
    // What nobody has seen yet must not get lost.
    if (ready_ && !what->subject) what->subject = ready_->subject;
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
    if (what) emit shown(std::move(what));
}

}  // namespace mrose::gui
