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

Expected<void> BackgroundWork::start(const QString& what, Job job, Done done) {
    if (running_) return fail("", "\"" + what_.toStdString() + "\" is under way; wait for its end, or end it (Esc)");
    what_ = what;
    running_ = true;
    share_ = 0;
    cancelled_ = false;
    reporting_.start();
    atWork_ = true;
    queue_.run(
        [this, job = std::move(job)](const GoesOn&) {
            Outcome outcome = caught([&] {
                return job([this](double share) {
                    share_ = share;
                    return !cancelled_ && !quit_;
                });
            });
            atWork_ = false;
            atWork_.notify_all();
            return outcome;
        },
        [this, done = std::move(done)](const Outcome& outcome) {
            reporting_.stop();
            running_ = false;
            emit progress(what_, 1);
            done(outcome);
        });
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
