#pragma once

#include <span>
#include <vector>

#include "geometry/point.h"
#include "logs/robot_log.h"

namespace mrose {

/// That a ball's velocity changed at once: something touched it.
struct BallEvent {
    Nanoseconds time = 0;
    Point place;                             ///< m
    bool rested = false;                     ///< it lay still before
    Point before, after;                     ///< m/s
    double beforeError = 0, afterError = 0;  ///< m/s, standard errors of either coordinate
};

/// That a ball slid until it rolled, after an event.
struct BallSlide {
    std::size_t event = 0;                           ///< in BallAnalysis::events
    double deceleration = 0, decelerationError = 0;  ///< m/s2, of the sliding
    double kept = 0, keptError = 0;                  ///< speed when it rolls over speed at the event
    double duration = 0, durationError = 0;          ///< s
};

/// A stretch in which it rolled.
struct BallRoll {
    double deceleration = 0, error = 0;  ///< m/s2
    double speed = 0;                    ///< m/s, in the mean
};

/// What one tracked ball did.
struct BallAnalysis {
    std::vector<BallEvent> events;
    std::vector<BallSlide> slides;
    std::vector<BallRoll> rolls;
    double noise = 0;         ///< m, of the tracker: standard deviation of a coordinate
    double moved = 0;         ///< s in which it moved
    std::size_t misfits = 0;  ///< stretches that are no free motion as far as can be seen: left out
};

/// Finds the touches as sharp bends of the track and fits what lies between: a ball slides with even deceleration, then
/// rolls with another one. Nothing of fewer than 20 positions. `noise`: of the tracker, m; 0: from the track itself.
BallAnalysis analyseBallTrack(std::span<const StampedBall> ball, double noise = 0);

/// m, the standard deviation of a coordinate of a tracked ball, by what third differences leave; 0 of too few.
double trackerNoise(std::span<const StampedBall> ball);

}  // namespace mrose
