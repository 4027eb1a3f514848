#pragma once

#include <vector>

#include "control/observation.h"
#include "geometry/shape.h"
#include "sensing/sensor_view.h"

namespace mrose {

/// Whether the straight line between two points passes through the inside of a piece, all in one frame.
bool crosses(const ConvexPiece& piece, const Point& from, const Point& to);

/// Takes away the bodies that the robot could not see when `map` was, because an obstacle or another body's shape
/// lay on the line between the reference points. The bodies' numbers in the world are `first` + SeenBody::index.
void removeHidden(const SensorView& view, const BodyMap& map, std::size_t first, std::vector<SeenBody>& seen);

}  // namespace mrose
