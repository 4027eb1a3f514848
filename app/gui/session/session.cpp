#include "session/session.h"

#include <algorithm>
#include <utility>

#include "io/caught.h"
#include "widgets/qt_text.h"

namespace mrose::gui {

using Kind = Requests::Kind;
using Clock = LiveRun::Clock;

Session::Session(QObject* parent)
    : QObject(parent),
      live_([this](const Expected<void>& written) {
          const QString error = written ? QString() : qtText(written.error().message());
          emit recordingChanged({}, error);
          if (quits_ && !written) qWarning("%s", qPrintable(error));  // no receiver is left
      }),
      worker_([this] { work(); }) {}

Session::~Session() { quit(); }

void Session::quit() {
    requests_.quit();
    if (worker_.joinable()) worker_.join();
}

std::uint64_t Session::open(const OpenedRun& run) {
    runName_ = run.name;
    emit opening(run);
    const std::uint64_t number = requests_.beginRun();
    requests_.add([this, run, number] {
        live_.open(run);
        runNumber_ = number;
    });
    return number;
}

void Session::ask(std::function<void(Debugger&)> what, std::optional<std::uint64_t> ofRun) {
    requests_.add([this, what = std::move(what), ofRun] {
        if (!debugger_.isOpen() || (ofRun && *ofRun != runNumber_)) return;
        const std::pair before(debugger_.playing(), debugger_.run().tick());
        what(debugger_);
        if (before != std::pair(debugger_.playing(), debugger_.run().tick())) live_.anchor();
    });
}

void Session::pause() {
    ask([](Debugger& debugger) { debugger.stop(); });
}

void Session::setSpeed(double speed) {
    requests_.add([this, speed] { live_.setSpeed(speed); });
}

void Session::seek(std::int64_t tick, bool breaks) {
    requests_.add(
        [this, tick, breaks] {
            if (debugger_.isOpen()) goTo(tick, breaks);
        },
        Kind::seek);
}

void Session::goTo(std::int64_t tick, bool breaks) {
    if (requests_.outdated()) return;
    debugger_.goTo(tick, breaks, watch([this](double) { return !requests_.waiting() && !requests_.outdated(); }));
    live_.anchor();
}

void Session::branchOff(const Edit& edit, std::optional<std::int64_t> seek, std::function<void()> begun) {
    const auto branch = [this, edit, seek, begun = std::move(begun)] {
        if (!debugger_.isOpen() || !debugger_.branchOff(edit)) return;
        if (begun) begun();
        if (seek) goTo(*seek, false);
        debugger_.sayBranched();
    };
    requests_.add(branch, seek ? Kind::lasting : Kind::quick);
}

void Session::goToBreak(const BreakWish& wish, BreakReach reach) {
    const QString what = !wish.back          ? tr("Running to the next break")
                         : wish.text.empty() ? tr("Looking for the last break")
                                             : tr("Looking for when it last held: %1").arg(wish.text.c_str());
    requests_.add(
        [this, wish, reach, what] {
            if (!debugger_.isOpen()) return;
            emit working(what, 0);
            debugger_.goToBreak(wish, reach, watch(progressOf(what)));
            emit working(what, 1);
            live_.anchor();
        },
        Kind::lasting);
}

Progress Session::progressOf(const QString& what, bool finishes) {
    return [this, what, finishes, reportedAt = Clock::now()](double share) mutable {
        if (Clock::now() - reportedAt >= 2 * LiveRun::framePeriod) {
            emit working(what, share);
            reportedAt = Clock::now();
        }
        return finishes ? !requests_.cancelled() : !requests_.outdated();
    };
}

/// What is shown goes along, frame by frame.
Watch Session::watch(Progress goesOn) {
    return {std::move(goesOn), [this, shownAt = Clock::now()]() mutable {
                if (Clock::now() - shownAt < LiveRun::framePeriod) return;
                serveLooks();
                live_.followRecording();
                publish();
                shownAt = Clock::now();
            }};
}

void Session::doLongWork(const QString& what, std::function<void(TimeTravel&, const Progress&)> job, bool finishes) {
    requests_.add(
        [this, what, job = std::move(job), finishes] {
            if (!debugger_.isOpen()) return;
            emit working(what, 0);
            debugger_.say({});
            job(debugger_.run(), progressOf(what, finishes));
            emit working(what, 1);
            live_.anchor();
        },
        Kind::lasting);
}

void Session::record(const QString& path, const QString& commandLine, bool overwrite) {
    requests_.add([this, path, commandLine, overwrite] {
        if (!debugger_.isOpen()) return;
        const auto begun = live_.record(path.toStdString(), commandLine.toStdString(), overwrite);
        emit recordingChanged(begun ? path : QString(), begun ? QString() : qtText(begun.error().message()));
    });
}

void Session::stopRecording() {
    requests_.add([this] { live_.stopRecording(); });
}

void Session::setFrameOptions(const FrameOptions& options) {
    requests_.add([this, options] { frameOptions_ = options; });
}

void Session::look(const Look& what) {
    const bool comes =
        requests_.addLook([this, what] { what(debugger_.isOpen() ? &debugger_.run() : nullptr, runNumber_); });
    if (!comes) what(nullptr, 0);
}

void Session::serveLooks() {
    for (const auto& look : requests_.takeLooks())
        if (const auto done = caught(look); !done) emit failed(qtText(done.error().message()));
}

void Session::settle() {
    requests_.settle();
    deliver();
}

void Session::work() {
    auto nextFrame = Clock::now();
    while (requests_.wait(live_.goesOn() ? std::optional(nextFrame) : std::nullopt)) {
        serveLooks();
        if (!requests_.waiting() && Clock::now() < nextFrame) continue;
        const bool asked = requests_.carryOut([this](const std::function<void()>& what) {
            if (const auto done = caught(what); !done) giveUp(done.error());
        });
        const auto changed = caught([&] { return live_.turn(asked, [this](double) { return !requests_.waiting(); }); });
        if (!changed) giveUp(changed.error());
        if (debugger_.isOpen() && changed.value_or(true))
            if (const auto shown = caught([this] { publish(); }); !shown) giveUp(shown.error());
        nextFrame = std::max(Clock::now(), nextFrame + LiveRun::framePeriod);
    }
    serveLooks();
    quits_ = true;
    const auto done = caught([this] { live_.stopRecording(); });
    if (!done) qWarning("%s", done.error().message().c_str());
}

void Session::giveUp(const Error& error) {
    live_.giveUp();
    emit working({}, 1);
    emit failed(qtText(error.message()));
}

void Session::publish() {
    auto what = std::make_shared<Shown>(debugger_.takeShown(frameOptions_));
    what->run = runNumber_;
    what->realTimeFactor = live_.realTimeFactor();
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
