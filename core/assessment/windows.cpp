#include "assessment/windows.h"

#include <algorithm>
#include <cmath>

#include "assessment/tracker_history.h"
#include "geometry/point.h"
#include "io/format.h"
#include "logs/pose_grid.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr Nanoseconds firstStart = 2'000'000'000;  // after the grid's begin
constexpr Nanoseconds gap = 200'000'000;           // truth is not interpolated across this
constexpr Nanoseconds velocityBase = 100'000'000;  // truth before a start from which its velocity can be measured
constexpr Nanoseconds travelStep = 500'000'000;
constexpr std::size_t stepsBeforeStart = 2;

bool hasGap(const std::vector<StampedPose>& poses, Nanoseconds from, Nanoseconds to) {
    for (std::size_t i = 1; i < poses.size(); ++i)
        if (poses[i].time - poses[i - 1].time >= gap && poses[i].time > from && poses[i - 1].time < to) return true;
    return false;
}

/// Why stretches were not taken, for the message when none was.
struct Refusals {
    int noTruth = 0, tooShort = 0, gaps = 0, still = 0;

    std::string text() const {
        std::string reasons;
        const auto add = [&](int count, const char* what) {
            if (count > 0) reasons += (reasons.empty() ? "" : ", ") + std::to_string(count) + " " + what;
        };
        add(noTruth, "without ground truth");
        add(tooShort, "too short");
        add(gaps, "with a gap in the ground truth");
        add(still, "in which the robot hardly moves");
        return reasons.empty() ? "it has no trajectory" : reasons;
    }
};

class Finder {
public:
    Finder(const Log& log, const WindowOptions& options, Nanoseconds spacing)
        : log_(log), options_(options), spacing_(spacing) {}

    void search(std::size_t robot) {
        for (std::size_t i = 0; i < log_.robots[robot].trajectories.size(); ++i) search(robot, i);
    }

    std::vector<Window> windows;
    Refusals refusals;

private:
    void search(std::size_t robot, std::size_t index) {
        const Trajectory& trajectory = log_.robots[robot].trajectories[index];
        Window window;
        window.robot = robot;
        window.trajectory = index;
        if (trajectory.poses.empty())
            ++refusals.noTruth;
        else if (!cut(trajectory, window))
            takeWhole(trajectory, window);
    }

    /// The referee's rule; false when the trajectory is too short for it.
    bool cut(const Trajectory& trajectory, const Window& blank) {
        const PoseGrid grid = poseGrid(trajectory, options_.step);
        const std::size_t horizon = static_cast<std::size_t>(options_.horizon / options_.step);
        const std::size_t first = static_cast<std::size_t>(firstStart / options_.step);
        if (first < stepsBeforeStart || grid.size() <= first + horizon + 1) return false;
        const std::size_t stride = static_cast<std::size_t>(std::max(spacing_ / options_.step, Nanoseconds{1}));
        for (std::size_t start = first; start + horizon + 1 < grid.size(); start += stride) {
            const auto ok = grid.ok.begin() + static_cast<std::ptrdiff_t>(start);
            if (!std::all_of(ok - stepsBeforeStart, ok + static_cast<std::ptrdiff_t>(horizon) + 1,
                             [](bool good) { return good; })) {
                ++refusals.gaps;
                continue;
            }
            Window window = blank;
            window.start = grid.time(start);
            const auto poses = grid.poses.begin() + static_cast<std::ptrdiff_t>(start);
            window.truth.assign(poses, poses + static_cast<std::ptrdiff_t>(horizon) + 1);
            take(trajectory, std::move(window));
        }
        return true;
    }

    void takeWhole(const Trajectory& trajectory, Window window) {
        const Nanoseconds first = trajectory.poses.front().time, last = trajectory.poses.back().time;
        const Nanoseconds onGrid = last / options_.step * options_.step;
        const bool longEnough = onGrid - options_.horizon >= first;
        window.start = longEnough ? onGrid - options_.horizon : first;
        const Nanoseconds length = std::min(options_.horizon, (last - window.start) / options_.step * options_.step);
        if (length < std::min(options_.shortest, options_.horizon)) {
            ++refusals.tooShort;
            return;
        }
        if (hasGap(trajectory.poses, window.start, window.start + length)) {
            ++refusals.gaps;
            return;
        }
        for (Nanoseconds t = 0; t <= length; t += options_.step)
            window.truth.push_back(truthAt(trajectory.poses, window.start + t));
        take(trajectory, std::move(window));
    }

    void take(const Trajectory& trajectory, Window window) {
        if (!measureTravel(window, options_)) {
            ++refusals.still;
            return;
        }
        const auto start = measureStart(trajectory, window.start, window.steps());
        if (!start) {
            ++refusals.gaps;
            return;
        }
        window.measuredPose = start->pose;
        window.measuredVelocity = start->velocity;
        window.steady = trajectory.steady;
        windows.push_back(std::move(window));
    }

    const Log& log_;
    const WindowOptions& options_;
    Nanoseconds spacing_;
};

}  // namespace

Travel travelled(std::span<const Pose> poses, Nanoseconds step) {
    const std::size_t stride = static_cast<std::size_t>(std::max<Nanoseconds>(1, travelStep / step));
    Travel travel;
    for (std::size_t i = 0; i + 1 < poses.size(); i += stride) {
        const Pose &a = poses[i], &b = poses[std::min(i + stride, poses.size() - 1)];
        travel.path += distance(position(a), position(b));
        travel.rotation += std::abs(b.heading - a.heading);
    }
    return travel;
}

Expected<void> checkOverlap(const std::string& robot, const Trajectory& trajectory) {
    const Nanoseconds commanded[] = {trajectory.commands.front().time, trajectory.commands.back().time},
                      tracked[] = {trajectory.poses.front().time, trajectory.poses.back().time};
    if (commanded[0] <= tracked[1] && tracked[0] <= commanded[1]) return {};
    const auto span = [](const Nanoseconds(&times)[2]) {
        return "from " + secondsText(times[0]) + " to " + secondsText(times[1]) + " s";
    };
    return fail({}, "has commands of robot \"" + robot + "\" " + span(commanded) + " and its ground truth " +
                        span(tracked) + "; expected both of the same time");
}

bool measureTravel(Window& window, const WindowOptions& options) {
    const Travel travel = travelled(window.truth, options.step);
    window.path = travel.path;
    window.rotation = travel.rotation;
    window.pathBySteps = 0;
    for (std::size_t i = 1; i < window.truth.size(); ++i)
        window.pathBySteps += distance(position(window.truth[i - 1]), position(window.truth[i]));
    const double part = toSeconds(window.steps() * options.step) / 10;
    return window.path >= options.leastPath * part || window.rotation >= options.leastRotation * part;
}

bool drives(const Window& window, const WindowOptions& options) {
    return window.path > 0 && window.path >= options.leastPath * (window.steps() * toSeconds(options.step) / 10);
}

void classifyManoeuvres(const Log& log, std::span<Window> windows, Nanoseconds step) {
    std::vector<CommandScale> scales;
    for (const RobotLog& robot : log.robots) scales.push_back(commandScale(robot));
    for (Window& w : windows)
        w.manoeuvre = classify(log.robots[w.robot].trajectories[w.trajectory], w.start, w.start + w.steps() * step,
                               scales[w.robot]);
}

Expected<RolloutStart> measureStart(const Trajectory& trajectory, Nanoseconds time, int steps) {
    RolloutStart start{&trajectory, time, {}, {}, steps};
    const auto& poses = trajectory.poses;
    if (poses.empty() || poses.front().time > time || poses.back().time < time - gap)
        return fail({}, "no ground truth at the start " + secondsText(time) + " s");
    if (poses.front().time > time - velocityBase && trajectory.measuredVelocity.empty()) {
        const auto later = std::upper_bound(poses.begin(), poses.end(), time,
                                            [](Nanoseconds t, const StampedPose& p) { return t < p.time; });
        start.pose = (later - 1)->pose;
        return start;
    }
    const MeasuredStart measured = measuredStart(trajectory, time);
    if (!measured.valid) return fail({}, "no ground truth within 0.2 s before the start " + secondsText(time) + " s");
    start.pose = measured.pose;
    start.velocity = measured.velocity;
    return start;
}

std::vector<RolloutStart> rolloutStarts(const Log& log, std::span<const Window> windows) {
    std::vector<RolloutStart> starts;
    starts.reserve(windows.size());
    for (const Window& w : windows)
        starts.push_back(
            {&log.robots[w.robot].trajectories[w.trajectory], w.start, w.measuredPose, w.measuredVelocity, w.steps()});
    return starts;
}

std::vector<std::size_t> robotsOf(std::span<const Window> windows) {
    std::vector<std::size_t> robots;
    for (const Window& window : windows) robots.push_back(window.robot);
    return robots;
}

std::vector<Window> denseStretches(const Log& log, std::size_t robot, const WindowOptions& options,
                                   Nanoseconds spacing) {
    Finder finder(log, options, spacing);
    finder.search(robot);
    return std::move(finder.windows);
}

Expected<std::vector<Window>> findWindows(const Log& log, const std::vector<std::string>& robots,
                                          const WindowOptions& options) {
    if (options.step <= 0 || options.horizon <= 0 || options.horizon % options.step != 0)
        return fail(
            {}, secondsText(options.horizon) + " s is no whole number of steps of " + secondsText(options.step) + " s",
            0, "horizon");
    for (const std::string& wanted : robots)
        if (std::none_of(log.robots.begin(), log.robots.end(), [&](const RobotLog& r) { return r.robot == wanted; }))
            return fail(log.source, "has no robot " + wanted);
    Finder finder(log, options, options.horizon);
    for (std::size_t i = 0; i < log.robots.size(); ++i)
        if (robots.empty() || std::find(robots.begin(), robots.end(), log.robots[i].robot) != robots.end())
            finder.search(i);
    if (finder.windows.empty())
        return fail(log.source,
                    "has no window of " + secondsText(options.horizon, 0) + " s to predict: " + finder.refusals.text());
    classifyManoeuvres(log, finder.windows, options.step);
    return std::move(finder.windows);
}

}  // namespace mrose
