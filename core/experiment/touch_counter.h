#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/step.h"

namespace mrose {

/// Finds where bodies begin to touch: pairs that touch in a tick and did not in the one before.
class TouchCounter {
public:
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
    std::vector<Pair> touching_, before_, begun_;
};

}  // namespace mrose
