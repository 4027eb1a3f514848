#pragma once

#include <initializer_list>
#include <limits>
#include <optional>
#include <vector>

#include "quantities/quantity.h"

namespace mrose {

// The parts of the catalogue, each in a file of its own.
void addMotionQuantities(std::vector<Quantity>& all);
void addControlQuantities(std::vector<Quantity>& all);
void addRealQuantities(std::vector<Quantity>& all);

/// Quantities that the inspector lists together, read from the same things.
inline void addQuantities(std::vector<Quantity>& all, const char* section, Quantity::Needs needs,
                          std::initializer_list<Quantity> some) {
    for (Quantity quantity : some) {
        quantity.section = section;
        quantity.needs = needs;
        all.push_back(quantity);
    }
}

constexpr double unknownNumber = std::numeric_limits<double>::quiet_NaN();

constexpr Unit count{"", 0}, share{"", 2}, metres{"m"}, tenthsOfMillimetres{"m", 4}, centimetres{"m", 1, "cm", 100},
    angle{"rad", 1}, fineAngle{"rad", 2}, metresPerSecond{"m/s"}, radiansPerSecond{"rad/s"}, seconds{"s"},
    roughSeconds{"s", 2}, newtonSeconds{"N s", 2};

inline const RobotState& robotOf(const Subject& s) { return s.at.state->robots[s.body]; }
inline const ObjectState& objectOf(const Subject& s) { return s.at.state->objects[s.body - s.at.state->robots.size()]; }
inline bool isRobot(const Subject& s) { return s.body < s.at.state->robots.size(); }
inline const Pose& poseOf(const Subject& s) { return Scenario::poseOf(*s.at.state, s.body); }
inline const Pose& otherPose(const Subject& s) { return Scenario::poseOf(*s.at.state, s.other); }
inline double partOr(const std::optional<Pose>& pose, double Pose::*part) {
    return pose ? (*pose).*part : unknownNumber;
}

}  // namespace mrose
