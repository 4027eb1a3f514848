#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "comparison/reality.h"
#include "scenario/scenario.h"
#include "simulation/step.h"
#include "widgets/trails.h"

namespace mrose {

/// What a robot saw, decided and was predicted to do at its last control instant: it holds until the next.
struct RobotInsight {
    std::int64_t tick = -1;  ///< of the state in which it decided; -1: never yet
    bool observed = false;
    Observation observation;
    Decision decision;
    MotionStep predicted;
    std::vector<std::byte> memoryBefore;  ///< its controller's, before it decided
};

/// Where the bodies were at the shown tick in another branch.
struct Ghost {
    std::string name;
    std::shared_ptr<const Scenario> scenario;  ///< of that branch: may have other bodies
    std::vector<Pose> bodies;                  ///< robots first, then objects
    Trails trails;                             ///< since the branches parted; may be empty
};

/// All that is known of the shown tick: what view, inspector and plots draw. A value; `scenario` is constant.
struct FieldFrame {
    std::shared_ptr<const Scenario> scenario;
    WorldState state;
    std::vector<RobotInsight> insights;        ///< of each robot
    std::vector<StepTrace::Robot> lastTick;    ///< what the tick that led here told of each robot; empty at a beginning
    std::vector<ContactReport> contacts;       ///< of that tick
    std::vector<StepTrace::Kicked> kicks;      ///< of the last moments
    Trails trails;                             ///< up to here
    std::vector<std::vector<Pose>> predicted;  ///< of each robot, if all go on as commanded; may be empty
    Nanoseconds predictedStep = 0;             ///< between those
    std::vector<Ghost> ghosts;
    std::vector<std::uint32_t> failed;       ///< robots whose controllers have failed up to here
    std::shared_ptr<const Reality> reality;  ///< what the real robots did at that time; may be null

    const Scene& scene() const { return scenario->scene(); }
    Nanoseconds now() const { return scene().timeOf(state.tick); }
    const Pose& poseOf(std::size_t body) const { return Scenario::poseOf(state, body); }
    const std::string& nameOf(std::size_t body) const {
        const Scene& s = scene();
        return body < s.robots.size() ? s.robots[body].name : s.objects[body - s.robots.size()].name;
    }
};

}  // namespace mrose
