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

/// How far many runs have come, for people.
struct RunsDone {
    std::int64_t runs = 0, done = 0, resumed = 0;
    bool complete = false;
};
/// What is said when they end: how many, how long it took, where results.csv is.
void printEnd(const RunsDone& of, double seconds, const std::string& folder);

}  // namespace mrose::cli
