#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "assessment/reality.h"
#include "debug/radio_log.h"
#include "debug/trails.h"
#include "quantities/catalogue.h"

namespace mrose {

/// Where the bodies were at the shown tick in another branch.
struct Ghost {
    std::string name;
    std::shared_ptr<const Scenario> scenario;  ///< of that branch: may have other bodies
    std::vector<Pose> bodies;                  ///< robots first, then objects
    Trails trails;                             ///< since the branches separated; may be empty
};

/// Where all bodies were at an instant before.
struct PosesThen {
    Nanoseconds time = 0;
    std::vector<Pose> bodies;  ///< robots first, then objects
};

/// All that is known of the shown tick: what view, inspector and plots draw. A value; `scenario` is constant.
struct FieldFrame {
    std::shared_ptr<const Scenario> scenario;
    WorldState state;
    std::vector<RobotInsight> insights;        ///< of each robot
    StepTrace lastTick;                        ///< of the tick that led here; empty at a beginning
    std::vector<StepTrace::Kicked> kicks;      ///< of the last moments
    RadioLog radio;                            ///< likewise
    Trails trails;                             ///< up to here
    std::vector<std::vector<Pose>> predicted;  ///< of each robot, if all go on as commanded; may be empty
    Nanoseconds predictedStep = 0;             ///< between those
    std::vector<Ghost> ghosts;
    std::vector<std::uint32_t> failed;       ///< robots whose controllers have failed up to here
    std::vector<PosesThen> measured;         ///< when what sensors reported last was measured, where that is known
    std::shared_ptr<const Reality> reality;  ///< what the real robots did at that time; may be null

    const Scene& scene() const { return scenario->scene(); }
    Nanoseconds now() const { return scene().timeOf(state.tick); }
    /// What is known of it; as long as it lives.
    Moment moment() const { return {scenario.get(), &state, &lastTick, insights, reality.get()}; }
    /// Where a body was when something was measured; nullptr: not known.
    const Pose* poseThen(std::size_t body, Nanoseconds time) const {
        if (time == now()) return &poseOf(body);
        for (const PosesThen& then : measured)
            if (then.time == time) return body < then.bodies.size() ? &then.bodies[body] : nullptr;
        return nullptr;
    }
    const Pose& poseOf(std::size_t body) const { return Scenario::poseOf(state, body); }
    const std::string& nameOf(std::size_t body) const { return nameOfBody(scene(), static_cast<std::uint32_t>(body)); }
};

}  // namespace mrose
