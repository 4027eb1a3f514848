#include "assessment/assess.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace mrose {
namespace {

/// Parts of the windows: kind, name and the indices of each. Parts that are all or nothing of their kind stay out,
/// except for robots.
struct Part {
    std::string kind, name;
    std::vector<std::size_t> windows;
};

template <class Belongs>
void addPart(std::vector<Part>& parts, std::span<const Window> windows, std::string kind, std::string partName,
             Belongs belongs) {
    Part part{std::move(kind), std::move(partName), {}};
    for (std::size_t i = 0; i < windows.size(); ++i)
        if (belongs(windows[i])) part.windows.push_back(i);
    if (!part.windows.empty()) parts.push_back(std::move(part));
}

std::vector<Part> partsOf(const LogWindows& log) {
    std::vector<Part> parts;
    for (std::size_t r = 0; r < log.robots.size(); ++r)
        addPart(parts, log.windows, "robot", log.robots[r].name, [r](const Window& w) { return w.robot == r; });
    for (int kind = 0; kind < manoeuvreCount; ++kind) {
        const auto manoeuvre = static_cast<Manoeuvre>(kind);
        addPart(parts, log.windows, "manoeuvre", std::string(name(manoeuvre)),
                [manoeuvre](const Window& w) { return w.manoeuvre == manoeuvre; });
    }
    std::vector<Part> states;
    addPart(states, log.windows, "state", "steady", [](const Window& w) { return w.steady; });
    addPart(states, log.windows, "state", "transient", [](const Window& w) { return !w.steady; });
    if (states.size() == 2) parts.insert(parts.end(), states.begin(), states.end());
    return parts;
}

/// The first stamp of each drive, by its name.
std::map<std::string, Nanoseconds> driveStarts(const Log& log) {
    std::map<std::string, Nanoseconds> starts;
    const auto note = [&](const std::string& drive, Nanoseconds time) {
        const auto [known, isNew] = starts.try_emplace(drive, time);
        if (!isNew) known->second = std::min(known->second, time);
    };
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            if (!trajectory.commands.empty()) note(trajectory.name, trajectory.commands.front().time);
            if (!trajectory.poses.empty()) note(trajectory.name, trajectory.poses.front().time);
        }
    return starts;
}

}  // namespace

LogWindows logWindows(const Log& log, std::vector<Window> windows, const WindowOptions& options) {
    LogWindows result{log.source,         log.format, log.dataset, log.synthetic, log.files, {}, options,
                      std::move(windows), {},         {}};
    for (const RobotLog& robot : log.robots) result.robots.push_back({robot.robot, robot.defects, 0});
    const auto starts = driveStarts(log);
    for (const Window& window : result.windows) {
        ++result.robots[window.robot].windows;
        result.trajectories.push_back(log.robots[window.robot].trajectories[window.trajectory].name);
        result.driveStarts.push_back(starts.at(result.trajectories.back()));
    }
    return result;
}

Assessment assess(const LogWindows& log, std::string name, std::vector<std::vector<Pose>> predicted) {
    Assessment result{.name = std::move(name), .predicted = std::move(predicted)};
    for (std::size_t i = 0; i < log.windows.size(); ++i)
        result.errors.push_back(windowErrors(log.windows[i].truth, result.predicted[i]));
    const auto summary = [&](std::span<const std::size_t> chosen) {
        return summarise(log.windows, result.errors, chosen, log.options);
    };
    std::vector<std::size_t> every(log.windows.size());
    std::iota(every.begin(), every.end(), std::size_t{0});
    result.all = summary(every);
    for (const Part& part : partsOf(log)) result.groups.push_back({part.kind, part.name, summary(part.windows)});
    result.overTime = errorsOverTime(result.errors, log.options.step);
    return result;
}

}  // namespace mrose
