#pragma once

#include <QObject>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "debug/plotted_value.h"
#include "session/session.h"
#include "widgets/curve_sampling.h"

namespace mrose::gui {

/// The past of values that are plotted: their numbers at every tick of the branches that are shown. A thread of its own
/// goes over the run's timeline and follows it as it grows; it steps beside the session and never blocks it. Numbers
/// that are there already are to be had at any time.
class ValueSeries final : public QObject {
    Q_OBJECT

public:
    /// Must end before the session does.
    explicit ValueSeries(Session& session);
    ~ValueSeries() override;

    /// The numbers of all others are forgotten.
    void want(std::vector<ValueKey> values);
    /// The branches of which they are wanted, the most urgent first, and how far each is known.
    struct Way {
        std::uint32_t branch = 0;
        std::int64_t first = 0, last = 0;  ///< ticks
    };
    /// Numbers that depend on the real log are forgotten where they came from another one.
    void follow(std::uint64_t run, std::shared_ptr<const Reality> reality, std::vector<Way> ways);
    /// Leaves out what has not been computed of the past. What comes is computed as ever.
    void cancel();
    /// Blocks until all that is wanted is known; for scripts and tests.
    void settle();

    /// Lets `read` see the numbers so far; not called where there are none. It must be quick: the thread waits.
    void read(std::uint32_t branch, const ValueKey& key, const std::function<void(const TickNumbers&)>& read) const;
    /// Ticks that are still to be computed.
    std::int64_t behind() const;

signals:
    void grown();

private:
    struct Walker;
    struct Task {
        std::uint64_t run = 0;
        std::uint32_t branch = 0;
        std::int64_t tick = 0, last = 0;
        std::vector<ValueKey> values;
        std::shared_ptr<const Reality> reality;
        bool front = false;
    };
    using Series = std::map<std::pair<std::uint32_t, ValueKey>, TickNumbers>;

    void work();
    std::optional<Task> nextTask() const;
    void go(const Task& task);
    struct Answer;
    std::optional<Answer> ask(const Walker& walker, const Task& task) const;
    bool prepare(Walker& walker, const Task& task);
    bool report(Walker& walker, const Task& task);
    void append(const Task& task, std::int64_t first, const std::vector<std::vector<float>>& columns);
    void giveUp(const Task& task, std::int64_t last);
    std::int64_t behindNow() const;
    bool frontWaits() const;
    void announce();

    Session& session_;
    /// Of the thread: for each branch one, and one more for a front.
    std::map<std::pair<std::uint32_t, bool>, std::unique_ptr<Walker>> walkers_;
    std::uint64_t walkersOf_ = 0;  ///< the run in which they walk

    mutable std::mutex mutex_;
    std::condition_variable wake_, settled_;
    std::uint64_t run_ = 0;
    std::vector<Way> ways_;
    std::vector<ValueKey> values_;
    std::shared_ptr<const Reality> reality_;
    Series series_;
    std::atomic<bool> quit_ = false;
    std::atomic<std::uint64_t> version_ = 0;  ///< of what is wanted
    bool announced_ = false;

    std::thread worker_;
};

/// What of a branch is to be computed next.
struct NextTicks {
    std::int64_t tick = 0;  ///< the first
    bool front = false;     ///< of the values that are known farthest: the newest go before another one's past
    std::vector<std::size_t> values;
};
/// `ends`: for each value the tick after the last that is known. nullopt: all are known.
std::optional<NextTicks> nextTicks(const ValueSeries::Way& way, const std::vector<std::int64_t>& ends);

}  // namespace mrose::gui
