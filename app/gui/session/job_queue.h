#pragma once

#include <QObject>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "io/error.h"

namespace mrose::gui {

/// Work in a thread of its own, one job after the other, whose answers come in the window's thread.
class JobQueue final : public QObject {
    Q_OBJECT

public:
    using GoesOn = std::function<bool()>;
    using Answer = std::function<void()>;
    /// Asks now and then whether it is still wanted. What it returns is called in the window's thread, unless it was
    /// dropped; it may be empty.
    using Job = std::function<Answer(const GoesOn& goesOn)>;
    /// Called in the window's thread where a job or an answer of its threw something: it has come to nothing.
    using Failed = std::function<void(const Error&)>;

    explicit JobQueue(QObject* parent = nullptr);
    ~JobQueue() override;

    void post(Job job, Failed failed);
    /// From within a job: something that it knows already.
    void report(Answer answer);
    /// Nothing that was posted is wanted any more.
    void drop();
    bool busy();
    /// Waits until all is done and delivered; for scripts and tests.
    void settle();

private:
    void work();
    void deliver();

    struct Posted {
        Job job;
        Failed failed;
    };
    struct Delivery {
        std::uint64_t since;
        Answer answer;
        Failed failed;
    };
    std::mutex mutex_;
    std::condition_variable wake_, done_;
    std::deque<Posted> jobs_;
    std::deque<Delivery> answers_;
    std::uint64_t dropped_ = 0;  ///< how often
    std::uint64_t running_ = 0;  ///< `dropped_` when the job under way began
    Failed failed_;              ///< of the job under way
    bool working_ = false, quit_ = false;
    std::thread worker_;
};

}  // namespace mrose::gui
