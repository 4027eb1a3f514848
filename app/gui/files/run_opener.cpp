#include "files/run_opener.h"

#include <utility>

#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

/// What is done sooner needs no word.
constexpr int openingPatience = 300;  // ms

}  // namespace

struct RunOpener::Job {
    OpenRequest request;
    Done done;
    std::atomic<bool> wanted{true};
    // Guarded by the opener's mutex.
    std::string reading;
    std::optional<Expected<OpenRun>> result;
    bool finished = false;
    std::thread thread;
};

RunOpener::RunOpener(QObject* parent) : QObject(parent) {
    progress_.setInterval(openingPatience);
    connect(&progress_, &QTimer::timeout, this, [this] {
        if (!job_) return;
        std::unique_lock lock(mutex_);
        const QString reading = qtText(job_->reading);
        lock.unlock();
        emit progress(reading);
    });
}

RunOpener::~RunOpener() {
    abandon();
    for (const auto& job : abandoned_) job->thread.join();
}

void RunOpener::open(const OpenRequest& request, Done done) {
    abandon();
    joinDone();
    job_ = std::make_shared<Job>();
    job_->request = request;
    job_->reading = request.file;
    job_->done = std::move(done);
    job_->thread = std::thread([this, job = job_.get()] { work(*job); });
    progress_.start();
}

void RunOpener::work(Job& job) {
    OpenProgress progress;
    progress.goesOn = [&job] { return job.wanted.load(); };
    progress.reads = [this, &job](const std::string& file) {
        const std::lock_guard lock(mutex_);
        job.reading = file;
    };
    Expected<OpenRun> result = openRun(job.request, progress);
    {
        const std::lock_guard lock(mutex_);
        job.result.emplace(std::move(result));
        job.finished = true;
        done_.notify_all();
    }
    QMetaObject::invokeMethod(this, &RunOpener::deliver, Qt::QueuedConnection);
}

void RunOpener::deliver() {
    joinDone();
    if (!job_) return;
    {
        const std::lock_guard lock(mutex_);
        if (!job_->finished) return;
    }
    const std::shared_ptr<Job> job = std::exchange(job_, nullptr);
    job->thread.join();
    progress_.stop();
    emit ended();
    job->done(std::move(*job->result));
}

void RunOpener::abandon() {
    if (!job_) return;
    job_->wanted = false;
    abandoned_.push_back(std::exchange(job_, nullptr));
    progress_.stop();
}

bool RunOpener::cancel() {
    if (!job_) return false;
    abandon();
    emit ended();
    return true;
}

void RunOpener::settle() {
    while (job_) {
        std::unique_lock lock(mutex_);
        done_.wait(lock, [this] { return job_->finished; });
        lock.unlock();
        deliver();
    }
}

void RunOpener::joinDone() {
    std::erase_if(abandoned_, [this](const std::shared_ptr<Job>& job) {
        {
            const std::lock_guard lock(mutex_);
            if (!job->finished) return false;
        }
        job->thread.join();
        return true;
    });
}

}  // namespace mrose::gui
