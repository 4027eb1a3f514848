#pragma once

#include <QObject>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/error.h"
#include "io/progress.h"

class QThread;

namespace mrose::gui {

/// Work off the frame: jobs in a thread of their own, one after the other, whose answers come in the window's thread.
/// Who wants several at a time has several queues. What is dropped is waited for by nobody: the next job begins at
/// once, in another thread, even where the dropped one hangs in a system call.
class JobQueue final : public QObject {
    Q_OBJECT

public:
    explicit JobQueue(QObject* parent = nullptr);
    ~JobQueue() override;

    /// `work` gets a GoesOn, which says whether it is still wanted, and gives an Expected; it knows values and this
    /// queue, not who asked for it, which may be gone before it ends. `take` gets what it gave in the window's thread,
    /// unless it was dropped. What `work` throws is its error; what `take` throws comes to it as an error once more.
    template <class Work, class Take>
    void run(Work work, Take take) {
        using Result = std::invoke_result_t<Work, const GoesOn&>;
        const auto taking = std::make_shared<Take>(std::move(take));
        post(
            [work = std::move(work), taking](const GoesOn& goesOn) -> Answer {
                auto result = std::make_shared<Result>(work(goesOn));
                return [result, taking] { (*taking)(std::move(*result)); };
            },
            [taking](const Error& error) { (*taking)(Result(tl::unexpected(error))); });
    }
    /// From within a job: `report` gets the share that is done, in the window's thread.
    Progress progress(const GoesOn& goesOn, std::function<void(double share)> report);

    using Answer = std::function<void()>;
    /// From within a job: something that it knows already, called in the window's thread.
    void report(Answer answer);
    /// Nothing that was posted is wanted any more.
    void drop();
    bool busy();
    /// Waits until all is done and delivered; for scripts and tests.
    void settle();

private:
    using Job = std::function<Answer(const GoesOn& goesOn)>;
    /// Called in the window's thread where a job or an answer of its threw something: it has come to nothing.
    using Failed = std::function<void(const Error&)>;
    struct Worker;
    void post(Job job, Failed failed);
    void begin();
    void work(Worker& worker);
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
    std::condition_variable done_;
    std::deque<Posted> jobs_;
    std::deque<Delivery> answers_;
    std::uint64_t dropped_ = 0;                     ///< how often
    std::vector<std::unique_ptr<Worker>> workers_;  ///< the last one is at work; those before were dropped
    bool working_ = false;
};

}  // namespace mrose::gui
