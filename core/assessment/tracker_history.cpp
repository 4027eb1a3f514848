#include "assessment/tracker_history.h"

#include <algorithm>

#include "assessment/truth_jumps.h"
#include "geometry/elementary.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

constexpr Nanoseconds gridStep = 100'000'000;
constexpr std::size_t gridSteps = 5;  // in one of its own
constexpr Nanoseconds stepLength = gridSteps * gridStep;
constexpr double forgetting = 60;    // s
constexpr double keptByAStep = 0.3;  // of what was seen before the heading turned at once
/// From an instant of the grid until it is known: poses that are part of its truth come by then, or there is none.
constexpr Nanoseconds untilKnown = truthGap;

/// By how much these poses move sideways in sum, beyond what arcs do.
double sidewaysOfWay(const Pose& start, std::span<const Pose> poses) {
    double sideways = 0;
    Pose before = start;
    for (const Pose& pose : poses) {
        sideways += TrackerEvidence::sidewaysOfArc(relative(before, pose));
        before = pose;
    }
    return sideways;
}

/// What the model makes of each step of the grid, by step; empty: it does not predict in these steps.
std::vector<std::vector<Pose>> expectedSteps(const Trajectory& trajectory, const PoseGrid& grid,
                                             const MotionModel& model) {
    std::vector<RolloutStart> starts;
    for (std::size_t i = 0; i + gridSteps < grid.size(); i += gridSteps) {
        const Nanoseconds time = grid.time(i);
        const Velocity velocity = measuredVelocity(trajectory, time).value_or(grid.velocities[i]);
        starts.push_back({.trajectory = &trajectory,
                          .time = time,
                          .pose = grid.poses[i],
                          .velocity = StampedVelocity{time, velocity},
                          .steps = static_cast<int>(gridSteps)});
    }
    return rollOut(model, starts, {.step = gridStep}).value_or(std::vector<std::vector<Pose>>());
}

}  // namespace

TrackerHistory::TrackerHistory(const Trajectory& trajectory, const MotionModel& model) {
    const PoseGrid grid = poseGrid(trajectory, gridStep, {truthSmoothed, truthSmoothed});
    if (grid.size() <= gridSteps) return;
    const std::vector<std::vector<Pose>> expected = expectedSteps(trajectory, grid, model);
    first_ = grid.time(gridSteps) + untilKnown;
    const std::vector<TruthJump> jumps =
        truthJumps(trajectory, grid.start - truthSmoothed, trajectory.poses.back().time);
    auto jump = jumps.begin();
    steps_ = headingSteps(trajectory);
    auto turned = steps_.begin();
    const double kept = decay(toSeconds(stepLength) / forgetting);
    TrackerEvidence evidence;
    for (std::size_t step = 0; step < expected.size(); ++step) {
        const std::size_t begin = step * gridSteps;
        while (jump != jumps.end() && jump->after < grid.time(begin) - truthSmoothed) ++jump;
        // One that ends after the step is known does not reach into it.
        const Nanoseconds end = grid.time(begin + gridSteps);
        const bool jumped =
            jump != jumps.end() && jump->before <= end + truthSmoothed && jump->after <= end + untilKnown;
        bool sound = !jumped && grid.ok[begin];
        double rotation = 0, forward = 0;
        for (std::size_t k = begin; k < begin + gridSteps; ++k) {
            sound = sound && grid.ok[k + 1];
            const Pose increment = relative(grid.poses[k], grid.poses[k + 1]);
            rotation += increment.heading;
            forward += increment.x;
        }
        const Pose& start = grid.poses[begin];
        const double sideways = sidewaysOfWay(start, std::span(grid.poses).subspan(begin + 1, gridSteps)) -
                                sidewaysOfWay(start, expected[step]);
        evidence.fade(kept);
        const auto fadeUpTo = [&](Nanoseconds time) {
            for (; turned != steps_.end() && turned->known <= end + untilKnown && turned->time <= time; ++turned)
                evidence.fade(keptByAStep);
        };
        fadeUpTo(end - stepLength / 2);
        if (sound) evidence.add(rotation, forward, sideways);
        fadeUpTo(end + untilKnown);
        evidence_.push_back(evidence);
    }
}

TrackerEvidence TrackerHistory::at(Nanoseconds time) const {
    if (evidence_.empty() || time < first_) return {};
    const auto index = std::min(static_cast<std::size_t>((time - first_) / stepLength), evidence_.size() - 1);
    TrackerEvidence evidence = evidence_[index];
    const Nanoseconds known = first_ + static_cast<Nanoseconds>(index) * stepLength;
    for (auto step = std::ranges::upper_bound(steps_, known, {}, &HeadingStep::known);
         step != steps_.end() && step->known <= time; ++step)
        evidence.fade(keptByAStep);
    return evidence;
}

const TrackerHistory& TrackerHistories::of(const Trajectory& trajectory, const MotionModel& model) {
    return known_.try_emplace({&trajectory, &model}, trajectory, model).first->second;
}

void fillTracked(const MotionModel& model, std::span<RolloutStart> starts) {
    TrackerHistories histories;
    for (RolloutStart& start : starts) start.tracked = histories.of(*start.trajectory, model).at(start.time);
}

}  // namespace mrose
