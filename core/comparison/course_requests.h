#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "comparison/log_world.h"
#include "evaluation/prediction_files.h"

namespace mrose {

/// A course to be driven: from a start that is the real robots', with nothing but their commands from there on.
struct CourseRequest {
    std::size_t take = 0;
    Nanoseconds start = 0;  ///< on the take's clock
    int steps = 0;
    std::optional<std::size_t> robot = std::nullopt;  ///< the only compared robot that is asked about; nothing: all
};

/// One stretch of a log, whole or restarted.
struct StretchOptions {
    Nanoseconds start = 0;                ///< on the take's clock
    std::optional<Nanoseconds> duration;  ///< nothing: to the end of the ground truth
    std::optional<Nanoseconds> every;     ///< restarted so often, in every take; nothing: one course in the first take
    Nanoseconds step = 100'000'000;
};

/// The courses of a stretch, all of one length. A stretch that reaches beyond the end of the ground truth ends there.
/// Error: the start lies beyond it, or no course fits in; a length that is no whole number of steps.
Expected<std::vector<CourseRequest>> coursesOf(const LogWorld& world, const StretchOptions& options);

/// A course for each of these windows whose robot and trajectory the world has, in their order.
std::vector<CourseRequest> coursesOfWindows(const LogWorld& world, std::span<const Window> windows);

/// A course for each window of this length that `mrose evaluate` has of the compared robots. Error: as for
/// findWindows(); the world has none of them.
Expected<std::vector<CourseRequest>> coursesOfAllWindows(const LogWorld& world, Nanoseconds length);

/// How long the windows of a log want to be whose takes are mostly too short to be restarted `every` so often: what
/// nine tenths of the trajectories hold, in whole steps, and no more than `every`. Nothing: courses of `every` cover at
/// least half of what was driven.
std::optional<Nanoseconds> windowsThatSuit(const LogWorld& world, Nanoseconds every);

/// A course for each window of a file; robots that are not compared are left out where `robots` names the compared
/// ones. Error: as for requestedStarts; a robot that the scenario does not play, or not in that trajectory.
Expected<std::vector<CourseRequest>> requestedCourses(const LogWorld& world, std::vector<WindowRequest> windows,
                                                      const std::vector<std::string>& robots, int steps,
                                                      const std::string& fileName);

}  // namespace mrose
