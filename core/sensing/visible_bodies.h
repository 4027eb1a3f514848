#pragma once

#include <vector>

#include "control/observation.h"
#include "scene/perception.h"

namespace mrose {

struct SensorView;

/// Bodies of one kind by their numbers in the world.
struct BodyRange {
    std::size_t first, count;
};

/// Those of them that a camera sees, exactly: as they were `sight.latency` ago in the robot's own frame of then, in the
/// order of their indices. Of `sight`, where it looks and whether anything hides them counts; noise and drop-outs are
/// the sensor's. Added to `seen`, which must be empty.
void visibleBodies(const SensorView& view, const BodySight& sight, const BodyRange& kind, std::vector<SeenBody>& seen);

}  // namespace mrose
