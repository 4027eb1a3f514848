#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>

namespace mrose::gui {

/// What other threads ask of one that carries it out, in order.
class Requests {
public:
    using Clock = std::chrono::steady_clock;
    enum class Kind {
        quick,
        lasting,  ///< the user may end it
        seek      ///< and it takes the place of one that was asked for just before and has not begun
    };
    void add(std::function<void()> what, Kind kind = Kind::quick);
    /// Served in between, whatever is carried out. False: the thread ends, or has ended.
    bool addLook(std::function<void()> look);
    /// What is asked for from now on is of another run: what was before is outdated. The run's number, from 1 on.
    std::uint64_t beginRun();
    std::uint64_t runs() const;
    /// Ends what takes long or waits for its turn; false: there is none.
    bool cancel();
    void quit();

    /// Whether something is carried out, or waits for it.
    bool busy() const;
    /// Blocks until all so far has been carried out.
    void settle();

    // Of the thread that carries them out.
    /// Waits for requests or looks, and no longer than until `atMost`, if that is given. False: quit() was called.
    bool wait(std::optional<Clock::time_point> atMost);
    std::deque<std::function<void()>> takeLooks();
    /// Carries out what has been asked for, one by one; whether there was any. Busy until the next wait().
    bool carryOut(const std::function<void(const std::function<void()>&)>& with);
    /// Whether something waits for its turn, or the end.
    bool waiting() const;
    // Of what is being carried out:
    bool cancelled() const;  ///< or the thread ends
    bool outdated() const;   ///< or cancelled

private:
    struct Request {
        std::function<void()> what;
        Kind kind = Kind::quick;
        std::uint64_t cancels = 0, runs = 0;  ///< those before it
    };
    bool isCancelled() const { return quit_ || cancels_ != current_.cancels; }

    mutable std::mutex mutex_;
    std::condition_variable wake_, settled_;
    std::deque<Request> requests_;
    std::deque<std::function<void()>> looks_;
    Request current_;
    std::size_t lasting_ = 0;               ///< requests that are not quick and not done yet
    std::uint64_t cancels_ = 0, runs_ = 0;  ///< how often something was to be ended; how many runs
    bool busy_ = false, quit_ = false;
};

}  // namespace mrose::gui
