#pragma once

#include <optional>
#include <vector>

#include "geometry/point.h"
#include "scene/environment.h"

namespace mrose {

/// What the reference localiser knows of a place.
struct WorldLandmarks {
    static constexpr std::size_t most = 64;
    std::vector<Point> points;
    Point middle;  ///< of all that stands there
};

/// The landmarks of an environment, where it has at least three; otherwise as fieldLandmarks() has them: the corners of
/// what stands there, the middles of its long sides, the corners of its goals, and four beacons 6 m outside. Of an open
/// place none.
WorldLandmarks worldLandmarks(const Environment& environment);

}  // namespace mrose
