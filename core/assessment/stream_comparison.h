#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/block_swaps.h"
#include "assessment/compared_sensors.h"
#include "assessment/metrics.h"
#include "assessment/rollout_readings.h"

namespace mrose {

template <class T>
struct RealAndSimulated {
    T real{}, simulated{};
};

/// Subjects in view within an interval of range (m) or bearing (rad), and the share of them that was reported.
struct ShareBin {
    double from = 0, to = 0;
    RealAndSimulated<BlockShare> reported;
};

/// Errors of what was reported: m or rad.
struct ReadingErrors {
    Distribution distribution;
    double deviation = unknownNumber;  ///< standard deviation
    double meanError = unknownNumber;  ///< standard error of the mean, by blocks
};
struct ComparedErrors {
    RealAndSimulated<ReadingErrors> of;
    TwoSampleTest test;  ///< of their distributions
};

/// How alike two streams of looks are. Looks of one stretch of `readingBlock` of the session's clock, of all robots
/// together, are one block: standard errors and tests take blocks to be independent and nothing else.
constexpr Nanoseconds readingBlock = 10 * nanosecondsPerSecond;
struct StreamFigures {
    std::size_t blocks = 0;  ///< with looks
    RealAndSimulated<std::size_t> looks;
    RealAndSimulated<BlockShare> reported;  ///< of the subjects in view
    RealAndSimulated<BlockShare> empty;     ///< of the looks: nothing reported
    TwoSampleTest reportedTest, emptyTest;  ///< of these shares
    std::vector<ShareBin> byRange, byBearing;
    ComparedErrors range, bearing;
};

/// A sensor's two streams in a comparison.
struct ComparedSensor {
    std::string name;
    SensorField field;
    LookStreams looks;  ///< by request, robot and time
    /// By compared robot; nullopt: it has no such sensor, or the log no looks of it. Bins are the same for all.
    std::vector<std::optional<StreamFigures>> robots;
    StreamFigures all;
};

/// The figures of all looks, and of each robot's. `requests` are the comparison's.
ComparedSensor compareStreams(const SensorPair& pair, LookStreams looks, std::span<const RolloutRequest> requests);

}  // namespace mrose
