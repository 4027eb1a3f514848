#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "assessment/rollout.h"
#include "assessment/truth_jumps.h"
#include "geometry/tracker_offset.h"
#include "logs/robot_log.h"

namespace mrose {

/// What the ground truth of a trajectory says of where the tracked point lies on the robot, beyond what a model of it
/// knows, as time goes on: how far the point moved sideways in steps of 0.5 s, less what the model expects of each.
/// What is a minute old counts 1/e as much, and what was seen before a HeadingStep 0.3. (README.md says how these were
/// chosen.) A step in which the truth jumps or
/// is not known says nothing. Nothing does where 0.1 s is no whole number of the model's periods.
class TrackerHistory {
public:
    TrackerHistory(const Trajectory& trajectory, const MotionModel& model);

    /// From truth at or before `time` alone, never later.
    TrackerEvidence at(Nanoseconds time) const;

private:
    Nanoseconds first_ = 0;                  ///< when evidence_[0] was known
    std::vector<TrackerEvidence> evidence_;  ///< every 0.5 s
    std::vector<HeadingStep> steps_;
};

/// The histories of trajectories, each made when it is first asked for. Trajectories and models must stay.
class TrackerHistories {
public:
    const TrackerHistory& of(const Trajectory& trajectory, const MotionModel& model);

private:
    std::map<std::pair<const Trajectory*, const MotionModel*>, TrackerHistory> known_;
};

/// Fills in RolloutStart::tracked for rollouts of this model.
void fillTracked(const MotionModel& model, std::span<RolloutStart> starts);

}  // namespace mrose
