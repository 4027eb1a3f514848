#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "assessment/reality.h"
#include "debug/opened_run.h"

namespace mrose::gui {

/// A real robot that drives one arc for good, and when it has no ground truth: seconds of the log's clock.
struct RealDrive {
    std::string robot;
    Pose start;
    Command command;
    std::vector<std::pair<double, double>> unseen = {};

    Pose poseAt(double seconds) const { return start * exp({command.v * seconds, 0, command.w * seconds}); }
};

/// A log of such drives: commands at 10 Hz, poses at `rate`, from 0 to `seconds`.
std::shared_ptr<const Log> logOfDrives(const std::vector<RealDrive>& drives, double seconds, std::int64_t rate = 40);

/// Adds a camera to the log: each robot reports all others and the landmarks, every `period` from the start on, at
/// ranges that are `off` too long. Landmarks are called by their numbers, from 1.
void addLooks(Log& log, const std::vector<RealDrive>& drives, const std::vector<Point>& landmarks, Nanoseconds period,
              double off);

/// Discs of 0.3 m that play all robots of a log on a floor of 10 m x 8 m about the origin, overlaid with it, from
/// `start` s of it on. They drive as told but `gain` times as fast. The bodies are called "sim " and the real one's
/// name. They have sensors, which their players read.
OpenedRun overlaidRun(std::shared_ptr<const Log> log, double start, double duration, double gain = 1,
                      const std::vector<SensorPointer>& sensors = {});

}  // namespace mrose::gui
