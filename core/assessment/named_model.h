#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "assessment/rollout.h"
#include "assessment/tracker_history.h"
#include "io/error.h"
#include "logs/robot_log.h"
#include "motion/motion_model.h"

namespace mrose {

/// A model under its name in tables. `forRobot` gives the model of a robot, named as in the log; null: it knows no such
/// robot. What it points to must outlive the evaluation.
struct NamedModel {
    std::string name;
    std::function<const MotionModel*(const std::string& robot)> forRobot;

    /// One model for every robot.
    static NamedModel same(std::string name, const MotionModel& model);
};

/// Fills in RolloutStart::tracked, of each start with the model of its robot; `robots` are indices into log.robots.
/// Starts of a robot that it does not know are left.
void fillTracked(const NamedModel& model, const Log& log, std::span<RolloutStart> starts,
                 std::span<const std::size_t> robots, TrackerHistories& histories);

/// Rollouts of one named model, each start with the model of its robot; `robots` are indices into log.robots. Error: as
/// for evaluate().
Expected<std::vector<std::vector<Pose>>> rollOut(const NamedModel& model, const Log& log,
                                                 std::span<const RolloutStart> starts,
                                                 std::span<const std::size_t> robots,
                                                 const RolloutOptions& options = {});

}  // namespace mrose
