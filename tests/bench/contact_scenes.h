#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace mrose::bench {

/// Twelve robots, square and round, that all drive into one corner.
Scenario corneredRobots();
/// Twenty boxes in a corner, and six robots that push them into it.
Scenario boxPile();
/// A ball between two robots that drive against each other at `speed` m/s.
Scenario pressedBall(double speed);
/// A ball that loses nothing, between walls that neither do.
Scenario elasticBall();
/// A box at a wall; pressed against it by a robot, or left alone.
Scenario boxAtWall(bool pressed);
/// Two bodies of tricky outlines that collide in the open, without floor friction; smooth where they lose nothing.
Scenario openCollision(std::int64_t number, double restitution);
/// A ball on a floor, no obstacles.
Scenario lonelyBall(double speed, double slidingFriction, double rollingDeceleration);
/// A ball on ice thrown at a wall whose face is at x = 4.
Scenario thrownBall(const Twist& velocity, double friction, double restitution);

}  // namespace mrose::bench
