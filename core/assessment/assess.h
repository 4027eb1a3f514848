#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/floor.h"
#include "assessment/metrics.h"
#include "assessment/windows.h"

namespace mrose {

/// What predictions are held against: a log's windows, and what reports say of the log. It holds no reference to it.
struct LogWindows {
    std::string source, format;
    int dataset = 0;
    bool synthetic = false;  ///< made by a simulated robot: pages say so wherever it could be mistaken
    std::vector<LogFile> files;
    struct Robot {
        std::string name;
        LogDefects defects;
        std::size_t windows = 0;
    };
    std::vector<Robot> robots;  ///< indexed by Window::robot
    WindowOptions options;
    std::vector<Window> windows;            ///< reports number them from 1
    std::vector<std::string> trajectories;  ///< by window: Trajectory::name
    /// By window: the first stamp of its drive, that is of all trajectories of that name. Pages count from there.
    std::vector<Nanoseconds> driveStarts;
    std::optional<Floor> floor = {}, turningFloor = {};  ///< where they were looked for

    const char* real() const { return realWord(synthetic); }
};
LogWindows logWindows(const Log& log, std::vector<Window> windows, const WindowOptions& options);

/// A part of the windows.
struct GroupSummary {
    std::string kind;  ///< what the windows are grouped by: "robot", "manoeuvre", "state"
    std::string name;  ///< "1", "hard switch", "steady"
    Summary summary;
};

/// What one predictor, a model or a simulated world, made of the windows, and how far off that is.
struct Assessment {
    std::string name;
    std::vector<std::vector<Pose>> predicted;  ///< by window
    std::vector<WindowErrors> errors;          ///< by window
    Summary all;
    std::vector<GroupSummary> groups;  ///< the same ones in the same order for every predictor
    std::vector<ErrorsAt> overTime;
    std::vector<RelativePoseError> relative = {};  ///< by horizon; of models
    PercentErrors onFloor, onTurningFloor;         ///< on the stretches of the floors' pairs; NaN without pairs
};
Assessment assess(const LogWindows& log, std::string name, std::vector<std::vector<Pose>> predicted);

}  // namespace mrose
