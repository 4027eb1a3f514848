#include "session/background_work.h"

#include <QEventLoop>
#include <utility>

#include "io/caught.h"

namespace mrose::gui {
namespace {

constexpr int reportEvery = 100;  // ms

}  // namespace

BackgroundWork::BackgroundWork(QObject* parent) : QObject(parent) {
    reporting_.setInterval(reportEvery);
    connect(&reporting_, &QTimer::timeout, this, [this] { emit progress(what_, share_); });
}

BackgroundWork::~BackgroundWork() {
    cancelled_ = true;
    if (thread_) thread_->wait();
}

Expected<void> BackgroundWork::start(const QString& what, Job job, Done done) {
    if (running_) return fail("", "\"" + what_.toStdString() + "\" is under way; wait for its end, or end it (Esc)");
    what_ = what;
    done_ = std::move(done);
    running_ = true;
    share_ = 0;
    cancelled_ = false;
    outcome_.reset();
    reporting_.start();
    atWork_ = true;
    // A thread of Qt's: jobs may wait for other programs.
    thread_.reset(QThread::create([this, job = std::move(job)] {
        const auto progress = [this](double share) {
            share_ = share;
            return !cancelled_ && !quit_;
        };
        outcome_ = caught([&] { return job(progress); });
        atWork_ = false;
        atWork_.notify_all();
        QMetaObject::invokeMethod(this, &BackgroundWork::finish, Qt::QueuedConnection);
    }));
    thread_->start();
    return {};
}

bool BackgroundWork::cancel() {
    if (!running_) return false;
    cancelled_ = true;
    return true;
}

void BackgroundWork::quit() {
    quit_ = true;
    atWork_.wait(true);
}

void BackgroundWork::finish() {
    thread_->wait();
    reporting_.stop();
    running_ = false;
    emit progress(what_, 1);
    const Done done = std::exchange(done_, {});
    const Outcome outcome = std::move(*outcome_);
    done(outcome);
}

void BackgroundWork::settle() {
    QEventLoop loop;
    connect(this, &BackgroundWork::progress, &loop, [this, &loop] {
        if (!running_) loop.quit();
    });
    if (running_) loop.exec();
    // What is done in the end may begin something else.
    if (running_) settle();
}

}  // namespace mrose::gui
