#pragma once

#include <optional>
#include <vector>

#include "debug/field_frame.h"
#include "geometry/area.h"

namespace mrose {

/// A real robot at a frame's time.
struct RealRobot {
    std::size_t index = 0;               ///< in Reality::robots
    std::optional<std::size_t> body;     ///< its simulated one; nullopt: that is not in the world
    std::optional<std::size_t> place;    ///< of that one: Scene::placeOf()
    const Shape* shape = nullptr;        ///< of its simulated one, or of the world's first robot; never null
    Pose pose;                           ///< now, or where it was measured last
    std::optional<Nanoseconds> lostFor;  ///< for how long it has not been known where it is; nullopt: it is known
    std::optional<PoseError> apart;      ///< of its simulated one; nullopt: one of the two is not there

    bool known() const { return !lostFor; }
};

/// What robots of the log are called beside simulated ones: Log::real().
const char* realWord(const FieldFrame& frame);
/// Those that have been seen so far, in the order of Reality::robots; empty where no reality is known.
std::vector<RealRobot> realRobots(const FieldFrame& frame);
/// The one that drove what a body repeats; nullopt: none.
std::optional<RealRobot> realRobotOf(const FieldFrame& frame, std::size_t body);
/// The body that stands for a real robot; nullopt: it is not in the world.
std::optional<std::size_t> bodyOf(const FieldFrame& frame, const Reality::Robot& robot);

/// All that real robots and models drive in the run's first minute.
Area areaOf(const Reality& reality);

}  // namespace mrose
