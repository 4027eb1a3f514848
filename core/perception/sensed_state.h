#pragma once

#include <algorithm>

#include "geometry/angle.h"
#include "geometry/pose.h"
#include "perception/view.h"
#include "world/command.h"

namespace mrose {

/// What a subject of a sensor is.
enum class SubjectKind { landmark, robot };

/// What is true at the instant of a measurement, as far as a reading may depend on it.
struct SensedState {
    static constexpr double hidden = 0.2, clear = 0.3;  ///< m
    static constexpr double apart = 0.6;                ///< rad

    Velocity velocity;  ///< of the sensor's robot: m/s, rad/s

    // Of a subject that is reported by range and bearing.
    SubjectKind subject = SubjectKind::landmark;
    double range = 0;      ///< m, from the robot's reference point
    double bearing = 0;    ///< rad in (-pi, pi], counter-clockwise from the robot's heading
    double edge = -1;      ///< from -1 well within the field of view over 0 at its edge to 1 outside
    double nearEdge = -1;  ///< likewise, of View::nearest
    /// How far the line to the subject passes beside the outline of the nearest body that is nearer: m, negative
    /// through it, from -hidden to clear.
    double clearance = clear;
    /// To the nearest other subject in view, and to the nearest that is nearer: rad, at most apart.
    double separation = apart, nearerSeparation = apart;
    double others = 0;  ///< how many other subjects are in view, were nothing hidden
    /// Share of the other robots whose place nobody knows, so that they may hide anything: 0 in a simulated world.
    double unknownRobots = 0;

    Pose own;  ///< of a robot that reports its own pose, in the world's frame
};

/// The clearance of a line, where a nearer body's outline is `aside` of it too.
inline double clearancePast(double clearance, double aside) {
    return std::max(std::min(clearance, aside), -SensedState::hidden);
}

/// Another subject in view.
inline void countOther(SensedState& state, double range, double bearing) {
    state.others += 1;
    const double angle = angleBetween(bearing, state.bearing);
    state.separation = std::min(state.separation, angle);
    if (range < state.range) state.nearerSeparation = std::min(state.nearerSeparation, angle);
}

/// Sets the edges of a subject whose range and bearing are known.
void findEdges(SensedState& state, const View& view);

}  // namespace mrose
