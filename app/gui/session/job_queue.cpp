#include "session/job_queue.h"

#include <QThread>
#include <algorithm>

#include "io/caught.h"

namespace mrose::gui {

/// A thread that does jobs until there are none, or the one that it does is dropped.
struct JobQueue::Worker {
    std::unique_ptr<QThread> thread;
    std::uint64_t since = 0;  ///< `dropped_` when it began
    Failed failed;            ///< of the job under way
    bool ended = false;

    /// The one whose thread this is.
    static thread_local Worker* current;
};

thread_local JobQueue::Worker* JobQueue::Worker::current = nullptr;

JobQueue::JobQueue(QObject* parent) : QObject(parent) {}

JobQueue::~JobQueue() {
    drop();
    for (const auto& worker : workers_) worker->thread->wait();
}

void JobQueue::post(Job job, Failed failed) {
    const std::lock_guard lock(mutex_);
    jobs_.push_back({std::move(job), std::move(failed)});
    if (!std::exchange(working_, true)) begin();
}

/// With the mutex held.
void JobQueue::begin() {
    std::erase_if(workers_, [](const auto& worker) { return worker->ended && worker->thread->wait(); });
    Worker& worker = *workers_.emplace_back(std::make_unique<Worker>());
    worker.since = dropped_;
    // A thread of Qt's: jobs may wait for other programs.
    worker.thread.reset(QThread::create([this, &worker] { work(worker); }));
    worker.thread->start();
}

void JobQueue::work(Worker& worker) {
    Worker::current = &worker;
    const GoesOn goesOn = [this, &worker] {
        const std::lock_guard held(mutex_);
        return worker.since == dropped_;
    };
    std::unique_lock lock(mutex_);
    while (worker.since == dropped_ && !jobs_.empty()) {
        const Job job = std::move(jobs_.front().job);
        worker.failed = std::move(jobs_.front().failed);
        jobs_.pop_front();
        lock.unlock();
        auto answer = caught([&] { return job(goesOn); });
        report(answer ? std::move(*answer)
                      : Answer([failed = worker.failed, error = answer.error()] { failed(error); }));
        lock.lock();
    }
    worker.ended = true;
    if (worker.since != dropped_) return;
    working_ = false;
    done_.notify_all();
}

Progress JobQueue::progress(const GoesOn& goesOn, std::function<void(double share)> report) {
    return [this, goesOn, report = std::move(report)](double share) {
        this->report([report, share] { report(share); });
        return goesOn();
    };
}

void JobQueue::report(Answer answer) {
    {
        const std::lock_guard lock(mutex_);
        if (Worker::current->since != dropped_) return;
        answers_.push_back({Worker::current->since, std::move(answer), Worker::current->failed});
    }
    QMetaObject::invokeMethod(this, &JobQueue::deliver, Qt::QueuedConnection);
}

void JobQueue::drop() {
    const std::lock_guard lock(mutex_);
    ++dropped_;
    jobs_.clear();
    answers_.clear();
    working_ = false;
    done_.notify_all();
}

bool JobQueue::busy() {
    const std::lock_guard lock(mutex_);
    return working_ || !answers_.empty();
}

void JobQueue::settle() {
    while (busy()) {
        std::unique_lock lock(mutex_);
        done_.wait(lock, [this] { return !working_; });
        lock.unlock();
        deliver();
    }
}

void JobQueue::deliver() {
    while (true) {
        std::unique_lock lock(mutex_);
        if (answers_.empty()) return;
        const Delivery delivery = std::move(answers_.front());
        answers_.pop_front();
        const bool wanted = delivery.since == dropped_;
        lock.unlock();
        if (!wanted) continue;
        if (const auto done = caught(delivery.answer); !done) delivery.failed(done.error());
    }
}

}  // namespace mrose::gui
