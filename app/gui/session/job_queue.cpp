#include "session/job_queue.h"

#include <utility>

#include "io/caught.h"

namespace mrose::gui {

JobQueue::JobQueue(QObject* parent) : QObject(parent), worker_([this] { work(); }) {}

JobQueue::~JobQueue() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
        ++dropped_;
        jobs_.clear();
    }
    wake_.notify_all();
    worker_.join();
}

void JobQueue::post(Job job, Failed failed) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back({std::move(job), std::move(failed)});
    }
    wake_.notify_all();
}

void JobQueue::report(Answer answer) {
    {
        const std::lock_guard lock(mutex_);
        answers_.push_back({running_, std::move(answer), failed_});
    }
    QMetaObject::invokeMethod(this, &JobQueue::deliver, Qt::QueuedConnection);
}

void JobQueue::drop() {
    const std::lock_guard lock(mutex_);
    ++dropped_;
    jobs_.clear();
    answers_.clear();
}

bool JobQueue::busy() {
    const std::lock_guard lock(mutex_);
    return working_ || !jobs_.empty() || !answers_.empty();
}

void JobQueue::settle() {
    while (busy()) {
        std::unique_lock lock(mutex_);
        done_.wait(lock, [this] { return !working_ && jobs_.empty(); });
        lock.unlock();
        deliver();
    }
}

void JobQueue::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return quit_ || !jobs_.empty(); });
        if (quit_) return;
        const Job job = std::move(jobs_.front().job);
        failed_ = std::move(jobs_.front().failed);
        jobs_.pop_front();
        working_ = true;
        running_ = dropped_;
        lock.unlock();
        const GoesOn goesOn = [this] {
            const std::lock_guard held(mutex_);
            return running_ == dropped_;
        };
        auto answer = caught([&] { return job(goesOn); });
        if (!answer)
            report([failed = failed_, error = answer.error()] { failed(error); });
        else if (*answer)
            report(std::move(*answer));
        lock.lock();
        working_ = false;
        done_.notify_all();
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
