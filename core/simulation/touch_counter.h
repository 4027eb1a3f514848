#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/step.h"

namespace mrose {

/// Finds where bodies begin to touch: pairs that touch in a tick and have been apart for a while. A robot that pushes a
/// ball or slides along a wall bounces off it again and again; that is one touch.
class TouchCounter {
public:
    static constexpr Nanoseconds apart = nanosecondsPerSecond / 5;  ///< so long they must not have touched

    explicit TouchCounter(Nanoseconds tickLength) : apartTicks_((apart + tickLength - 1) / tickLength) {}

    struct Pair {
        std::uint32_t first = 0, second = 0;  ///< bodies, first < second; noBody for what stands still
        bool operator==(const Pair&) const = default;
        bool operator<(const Pair& other) const {
            return first != other.first ? first < other.first : second < other.second;
        }
    };

    /// The pairs that began to touch in this tick, each once; until the next call.
    std::span<const Pair> add(const StepTrace& trace);

private:
    /// A pair and the last tick in which it touched.
    struct Recent {
        Pair pair;
        std::int64_t tick = 0;
    };

    std::int64_t apartTicks_, tick_ = 0;
    std::vector<Pair> touching_, begun_;
    std::vector<Recent> recent_, merged_;  ///< sorted
};

}  // namespace mrose
