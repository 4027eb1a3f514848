#include "assessment/tracker_history.h"

#include <algorithm>
#include <map>

#include "assessment/truth_jumps.h"
#include "geometry/elementary.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

constexpr Nanoseconds gridStep = 100'000'000;
constexpr std::size_t gridSteps = 5;  // in one of its own
constexpr Nanoseconds stepLength = gridSteps * gridStep;
constexpr double forgetting = 60;  // s
/// From an instant of the grid until it is known: poses that are part of its truth come by then, or there is none.
constexpr Nanoseconds untilKnown = truthGap;

}  // namespace

TrackerHistory::TrackerHistory(const Trajectory& trajectory) {
    const PoseGrid grid = poseGrid(trajectory, gridStep, {truthSmoothed, truthSmoothed});
    if (grid.size() <= gridSteps) return;
    first_ = grid.time(gridSteps) + untilKnown;
    const std::vector<TruthJump> jumps =
        truthJumps(trajectory, grid.start - truthSmoothed, trajectory.poses.back().time);
    auto jump = jumps.begin();
    const double kept = decay(toSeconds(stepLength) / forgetting);
    TrackerEvidence evidence;
    for (std::size_t i = 0; i + gridSteps < grid.size(); i += gridSteps) {
        while (jump != jumps.end() && jump->after < grid.time(i) - truthSmoothed) ++jump;
        // One that ends after the step is known does not reach into it.
        const Nanoseconds end = grid.time(i + gridSteps);
        const bool jumped =
            jump != jumps.end() && jump->before <= end + truthSmoothed && jump->after <= end + untilKnown;
        bool sound = !jumped;
        double rotation = 0, forward = 0, sideways = 0;
        for (std::size_t k = i; k < i + gridSteps; ++k) {
            sound = sound && grid.ok[k] && grid.ok[k + 1];
            const Pose increment = relative(grid.poses[k], grid.poses[k + 1]);
            rotation += increment.heading;
            forward += increment.x;
            sideways += TrackerEvidence::sidewaysOfArc(increment);
        }
        evidence.fade(kept);
        if (sound) evidence.add(rotation, forward, sideways);
        evidence_.push_back(evidence);
    }
}

TrackerEvidence TrackerHistory::at(Nanoseconds time) const {
    if (evidence_.empty() || time < first_) return {};
    const auto steps = static_cast<std::size_t>((time - first_) / stepLength);
    return evidence_[std::min(steps, evidence_.size() - 1)];
}

void fillTracked(std::span<RolloutStart> starts) {
    std::map<const Trajectory*, TrackerHistory> histories;
    for (RolloutStart& start : starts)
        start.tracked = histories.try_emplace(start.trajectory, *start.trajectory).first->second.at(start.time);
}

}  // namespace mrose
