#pragma once

#include <functional>
#include <thread>

namespace mrose {

/// Starts to watch for what asks a program to end: Ctrl-C (SIGINT), schedulers and `kill` (SIGTERM), a terminal that
/// closes (SIGHUP, unless it is ignored as under nohup). The last two may come several times, as they do; a Ctrl-C
/// after any of them ends the program at once.
void watchInterrupts();
bool wasInterrupted();
/// The exit status that says so: 128 + the first signal.
int interruptedStatus();

/// For programs that cannot ask: calls `action` in a thread of its own when an interrupt comes. One at a time, after
/// watchInterrupts().
class OnInterrupt {
public:
    explicit OnInterrupt(std::function<void()> action);
    OnInterrupt(const OnInterrupt&) = delete;
    OnInterrupt& operator=(const OnInterrupt&) = delete;
    ~OnInterrupt();  ///< waits for an action that has begun

private:
    std::thread thread_;
};

}  // namespace mrose
