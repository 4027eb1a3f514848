#pragma once

#include <cstdint>
#include <vector>

#include "logs/robot_log.h"
#include "scene/environment.h"
#include "synthetic/log_generator.h"

namespace mrose {

/// What is true of a run with a ball and no log holds.
struct BallTruth {
    /// The kick's, if there was one: s from the command, and in the robot's frame.
    struct Departure {
        double delay = 0;
        bool hit = false;
        Point place, velocity;
        Velocity robot;
    };
    /// A touch of a wall or the robot: speeds along the normal, towards it and away.
    struct Bounce {
        Nanoseconds time = 0;
        bool robot = false;
        double approach = 0, parting = 0;  ///< m/s
        Point place;                       ///< of the ball
    };
    std::vector<Departure> departures;
    std::vector<Bounce> bounces;
    std::vector<StampedBall> path;     ///< every 2 ms
    std::vector<double> rolling = {};  ///< m/s2, likewise: by which it is slowed down as it rolls; 0 where it slides
};

struct BallRun {
    std::vector<StampedCommand> commands;
    SyntheticRun robot;  ///< every SyntheticTracker::period
    std::vector<StampedKick> kicks;
    std::vector<StampedBall> ball;  ///< tracked
    BallTruth truth;
};

/// The reference ball in a hall of syntheticFieldLength by syntheticFieldWidth, with the reference robot. `kicks`: the
/// robot drives up to a ball that lies there and kicks it with some power, once; not every kick meets it. `throws`: the
/// robot stands, and somebody rolls the ball, at it or elsewhere. Restitution at walls and robot shrinks with speed.
/// `number` counts the kicks of a battery.
BallRun playBall(BallPlay play, double duration, std::uint64_t seed, std::int64_t number);

/// The camera above that tracks the ball: every 16 ms, with 2 mm of noise, in steps of 0.1 mm; one in a hundred is
/// missing. The floor of the hall, by which the reference ball rolls.
constexpr Nanoseconds ballTrackerPeriod = 16'000'000;
constexpr double ballTrackerNoise = 0.002, ballTrackerMissing = 0.01;
FloorSurface ballHallFloor();

/// Restitution of the hall's walls and of the robot, at a speed of approach in m/s.
double hallRestitution(bool robot, double approach);

}  // namespace mrose
