#pragma once

#include <chrono>
#include <optional>

#include "common.h"

namespace mrose::cli {

/// Shows how many of many runs are done, and about how long the rest takes.
class RunCount {
public:
    explicit RunCount(bool quiet) : line_(quiet) {}

    void show(std::int64_t done, std::int64_t all);
    void clear() { line_.clear(); }
    double seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    ProgressLine line_;
    Clock::time_point began_ = Clock::now(), next_ = began_ + std::chrono::seconds(1);
    std::int64_t doneBefore_ = -1;
};

}  // namespace mrose::cli
