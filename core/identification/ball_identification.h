#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/shape.h"
#include "identification/ball_track.h"
#include "io/error.h"
#include "logs/robot_log.h"

namespace mrose {

/// A quantity as events say it, each with its own error.
struct BallEstimate {
    bool identified = false;
    double value = 0, error = 0;  ///< standard error
    double spread = 0;            ///< standard deviation between events beyond their errors
    std::size_t events = 0;
    std::string reason = {};  ///< why it is not identified
};

/// The mean of values with standard errors where they differ by more than these say (DerSimonian and Laird 1986): the
/// spread between them is estimated, and counts in weights and error. Values farther than 5 robust standard deviations
/// from the median are left out. `fewest` events are needed.
BallEstimate meanOfEvents(std::span<const double> values, std::span<const double> errors, std::size_t fewest);

/// What tracked balls say of ball, floor, walls and robots.
struct BallIdentification {
    BallEstimate rollingDeceleration;  ///< m/s2
    double rollingSpeed = 0;           ///< m/s, in the mean, where that was
    BallEstimate slidingFriction;      ///< coefficient of the floor
    BallEstimate kept;          ///< share of a kicked ball's speed that is left when it rolls: inertia = 1 / kept - 1
    BallEstimate untilRolling;  ///< s for each m/s that it was kicked with
    BallEstimate inertia;       ///< over m r2
    BallEstimate wallRestitution, robotRestitution;

    double noise = 0;  ///< m, of the tracker
    double moved = 0;  ///< s in which the ball moved
    std::size_t positions = 0, tracks = 0, kicks = 0, touches = 0;
    std::size_t unexplained = 0;  ///< touches that nothing known is near to, where obstacles are given
    std::size_t oblique = 0;      ///< touches left out: the direction of the surface is not known
    std::size_t misfits = 0;      ///< stretches that are no free motion
    bool obstacles = false;       ///< of an environment were given
    bool synthetic = false;
    std::vector<std::string> unitDoubts = {};  ///< what in the log looks like other units, a sentence each
};

struct BallIdentificationOptions {
    /// Of the environment, in the frame of the log. Without them a touch far from robots is of a wall.
    std::vector<ConvexPiece> obstacles = {};
    double robotReach = 0.5;     ///< m: a touch with a robot's reference point so near is of the robot
    double obstacleReach = 0.3;  ///< m: likewise of the nearest obstacle
    /// rad: where a surface's normal is not known, the ball must come back within so much of the way that it came. Then
    /// friction along the surface hardly counts.
    double headOn = 0.35;
    double longestDelay = 1;  ///< s, from a kick's command to its ball
};

/// From all tracked balls of a log. Error: it has none, or none long enough; what cannot be identified of one that has
/// says why.
Expected<BallIdentification> identifyBall(const Log& log, const BallIdentificationOptions& options = {});

}  // namespace mrose
