#pragma once

#include <vector>

#include "geometry/point.h"
#include "geometry/pose.h"
#include "logs/measurements.h"

namespace mrose {

/// The field on which the reference robot starts, m: one corner lies at the origin.
inline constexpr double syntheticFieldLength = 9, syntheticFieldWidth = 5;

/// What its sensors know: four corner posts, the posts of two goals, two posts at the middle line, and
/// four beacons some metres outside.
const std::vector<LogSubject>& fieldLandmarks();

/// A landmark as a robot truly has it before it.
struct LandmarkInView {
    std::size_t subject = 0;        ///< in fieldLandmarks()
    double range = 0, bearing = 0;  ///< m; rad in (-pi, pi] from the robot's heading
    Point offset;                   ///< from the robot, in the field's frame
};
/// Those within `range` and half of `fieldOfView` to either side.
std::vector<LandmarkInView> landmarksInView(const Pose& pose, double range, double fieldOfView);

}  // namespace mrose
