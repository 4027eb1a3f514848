#pragma once

#include <span>
#include <string>
#include <vector>

#include "assessment/manoeuvre.h"
#include "assessment/rollout.h"
#include "io/error.h"
#include "logs/robot_log.h"

namespace mrose {

/// Which stretches of a log are predicted. The defaults are those of the referee of the MRCLAM logs.
struct WindowOptions {
    Nanoseconds step = 100'000'000;          ///< between compared poses
    Nanoseconds horizon = 10'000'000'000LL;  ///< a whole multiple of `step`
    double leastPath = 0.3;      ///< m per 10 s: a window has at least this path (in proportion to its length) ...
    double leastRotation = 1.0;  ///< rad per 10 s: ... or this rotation; else the robot hardly moves and it is left out
    Nanoseconds shortest = 1'000'000'000;  ///< a trajectory with less than this is no window
};

/// A stretch of truth and the measured start that a prediction of it has.
struct Window {
    std::size_t robot = 0, trajectory = 0;  ///< indices into Log::robots and RobotLog::trajectories
    Nanoseconds start = 0;
    std::vector<Pose> truth;  ///< at start, start + step, ...: steps() + 1 poses, heading continuous
    Pose measuredPose;        ///< at the start, from truth at or before it alone
    std::optional<StampedVelocity> measuredVelocity;  ///< likewise; none where truth does not reach back before it
    double path = 0, rotation = 0;  ///< m, rad; summed over 0.5 s steps, because a wobble inflates shorter ones
    double pathBySteps = 0;         ///< m; summed over the steps of `truth`, wobble and all
    Manoeuvre manoeuvre = Manoeuvre::straight;
    bool steady = false;  ///< Trajectory::steady

    int steps() const { return static_cast<int>(truth.size()) - 1; }
};

/// The windows of a log, by robot, trajectory and time. A trajectory long enough for it (about 4.6 s more than the
/// horizon) is cut as the referee cuts it: the grid of poseGrid, first start at its instant 20 (2 s), one window per
/// horizon whether or not the one before was taken, truth without a gap from two steps before the start to the end. A
/// shorter trajectory is one window: its last `horizon`, or the whole of it when it is shorter than that.
/// `robots` empty: all. Error: an unknown robot; a log without truth; no window at all (saying why).
Expected<std::vector<Window>> findWindows(const Log& log, const std::vector<std::string>& robots = {},
                                          const WindowOptions& options = {});

/// Error: the commands of one robot and its ground truth, both there, are of different times.
Expected<void> checkOverlap(const std::string& robot, const Trajectory& trajectory);

/// Fills in what the truth of a stretch says: path, rotation, pathBySteps. False: the robot hardly moves in it.
bool measureTravel(Window& window, const WindowOptions& options);

/// Whether it goes so far that an error can be divided by its path.
bool drives(const Window& window, const WindowOptions& options);

/// Fills in the manoeuvres, which follow from the commands of the log.
void classifyManoeuvres(const Log& log, std::span<Window> windows, Nanoseconds step);

/// Stretches like windows, of one robot, with a start every `spacing` (a whole multiple of the step) in trajectories
/// that are long enough for the referee's rule, so that they overlap when it is shorter than the horizon.
std::vector<Window> denseStretches(const Log& log, std::size_t robot, const WindowOptions& options,
                                   Nanoseconds spacing);

/// What a prediction starting at `time` may know: measuredStart. Without velocity where the truth begins less than 0.1
/// s before `time` and the robot did not measure its own: a rollout then starts with the model's. RolloutStart::tracked
/// is left to fillTracked(). Error: the truth does not reach to `time`.
Expected<RolloutStart> measureStart(const Trajectory& trajectory, Nanoseconds time, int steps);

/// The starts of the windows' rollouts. They point into `log`. RolloutStart::tracked is left to fillTracked().
std::vector<RolloutStart> rolloutStarts(const Log& log, std::span<const Window> windows);

/// Of each, as indices into Log::robots.
std::vector<std::size_t> robotsOf(std::span<const Window> windows);

/// Path length in metres and absolute rotation in radians over 0.5 s steps (and what remains at the end).
struct Travel {
    double path = 0, rotation = 0;
};
Travel travelled(std::span<const Pose> poses, Nanoseconds step);

}  // namespace mrose
