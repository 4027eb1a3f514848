#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geometry/shape.h"
#include "scene/environment.h"
#include "scene/perception.h"
#include "world/time.h"
#include "world/world_state.h"

namespace mrose {

class Sensor;
class LearnedKicker;

/// A kicker: a ball whose edge lies within its reach leaves it with the given speed along its direction; or, where it
/// is learned, when, whether, how fast and in which direction its network says (manipulation/).
struct Manipulator {
    std::string name;
    Point position;        ///< of the middle of its face, in the robot's frame, m
    double direction = 0;  ///< rad, in the robot's frame
    double speed = 3;      ///< m/s at full power, relative to the robot
    double reach = 0.05;   ///< m, how far before its face it meets the ball
    double width = 0.2;    ///< m, of its face
    Nanoseconds recharge = nanosecondsPerSecond;
    Nanoseconds deadTime = 0;  ///< from command to kick
    /// In the place of direction, speed, reach, width and dead time, which then only say what is usual of it.
    std::shared_ptr<const LearnedKicker> learned = {};
    bool operator==(const Manipulator&) const = default;
};

/// A kind of robot: all that its robots share but the motion model, which may differ from robot to robot.
struct RobotType {
    std::string name;
    std::shared_ptr<const Shape> shape;
    double mass = 10;  ///< kg, spread evenly over the shape
    Surface surface;
    std::vector<Manipulator> manipulators;               ///< at most maxManipulators
    Perception perception;                               ///< by the sensors that every robot has
    std::vector<std::shared_ptr<const Sensor>> sensors;  ///< further ones (sensing/)
    bool person = false;                                 ///< drawn and counted as one
};

}  // namespace mrose
