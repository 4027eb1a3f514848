#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "assessment/assess.h"
#include "assessment/rollout.h"
#include "io/error.h"

namespace mrose {

/// A window to predict, as a file names it.
struct WindowRequest {
    int dataset = 0;
    std::string robot;
    std::string trajectory;  ///< empty: the only one that has truth at the start
    Nanoseconds start = 0;
    int line = 0;  ///< where it stands in its file
};

/// Reads CSV with the columns dataset, robot, t_start in any order; other columns (path_m, rotation_rad) are not
/// needed, a column `trajectory` names one of several. Error with line and column: a missing column, a wrong number of
/// cells, something that is not a number, a window named twice.
Expected<std::vector<WindowRequest>> readWindows(const std::filesystem::path& file);
Expected<std::vector<WindowRequest>> parseWindows(std::string_view content, const std::string& fileName);

/// "6,1,1248446702.5": what the rows of a window begin with in these files.
std::string windowKey(int dataset, const std::string& robot, Nanoseconds start);

/// dataset,robot,t_start,path_m,rotation_rad as the referee prints them, and the trajectory.
std::string windowsCsv(const LogWindows& log);

/// The starts asked for, `robots[i]` the index into log.robots of the robot of `starts[i]`; they point into `log`.
/// Error with the request's line in `fileName`: another data set, an unknown robot, no truth at the start or in more
/// than one trajectory.
struct RequestedStarts {
    std::vector<RolloutStart> starts;
    std::vector<std::size_t> robots;
};
Expected<RequestedStarts> requestedStarts(const Log& log, std::span<const WindowRequest> requests, int steps,
                                          const std::string& fileName);

/// dataset,robot,t_start,t,x,y,heading: one row per window and instant, t the time since t_start in seconds. x and y to
/// 0.1 um, heading to 0.1 urad. Of several samples of each window t follows the columns sample, 0, 1, ..., and seed,
/// that of the starts when they are added; `at`: the steps that are written, from 1 on; empty: all.
class PredictionsCsv {
public:
    PredictionsCsv(const Log& log, const RequestedStarts& requested, Nanoseconds step, bool sampled,
                   std::vector<std::size_t> at);

    /// The poses after each step, of all windows in their order.
    void add(std::span<const std::vector<Pose>> predicted, int sample = 0);
    /// By window, and of a window by sample.
    std::string text() const;

private:
    const Log& log_;
    const RequestedStarts& requested_;
    Nanoseconds step_;
    bool sampled_, named_;
    std::vector<std::size_t> at_;
    std::vector<std::string> rows_;  ///< of each window
};

}  // namespace mrose
