#pragma once

#include <cstdint>
#include <vector>

#include "simulation/step.h"

namespace mrose {

/// What robots told each other in the last moments, oldest first.
struct RadioLog {
    /// So long it is kept, in at most so many entries.
    static constexpr Nanoseconds kept = nanosecondsPerSecond;
    static constexpr std::size_t most = 2000;

    struct Entry {
        std::int64_t tick = 0;  ///< the receiver's control instant
        SentMessage message;
        Transmission transmission;
    };
    std::vector<SentMessage> sent;
    std::vector<Entry> due;  ///< received, lost or out of range

    /// Adds what happened in the tick that led to `after`, and forgets what is older.
    void add(const Scene& scene, const WorldState& after, const StepTrace& trace);
    void clear() { sent.clear(), due.clear(); }
};

}  // namespace mrose
