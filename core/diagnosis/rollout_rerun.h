#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "assessment/compare.h"
#include "motion/noisy_model.h"

namespace mrose {

/// A rollout of one robot, run again with something otherwise.
class RolloutRerun {
public:
    /// `rollout` is what compare() made of `request` with `seed`; re-runs are `steps` long, at most as long as it. All
    /// must outlive this.
    RolloutRerun(const LogWorld& world, const RolloutRequest& request, const ComparedRollout& rollout, Nanoseconds step,
                 int steps, std::uint64_t seed);

    /// The robot's poses after each step. Where nothing is changed these are the rollout's own, to the last bit.
    using Poses = std::vector<Pose>;
    Poses later(Nanoseconds delay) const;  ///< all its commands so much later; sooner below zero
    Poses startingAt(const Velocity& velocity) const;
    Poses untouched() const;  ///< nothing stands in its way: no obstacle, no object, no other robot
    Poses movedBy(const std::shared_ptr<const MotionModel>& model) const;
    Poses noisy(const MotionNoise& noise, std::uint64_t seed) const;  ///< of the measured start's velocity too
    Poses obeying(std::span<const StampedCommand> more) const;  ///< these commands as well, stamped on the log's clock
    /// `command` instead of all its commands from `from` to before `to`, on the log's clock.
    Poses holding(const Command& command, Nanoseconds from, Nanoseconds to) const;

    /// Carried as the log has it from after step `from` (0: the start) to after step `to`, at which the truth must be
    /// known (at the start what was measured does), and restarted there where the simulated robot then is, as fast as
    /// the real one. The others are where the real ones are then.
    Poses carried(int from, int to) const;

    const Trajectory& trajectory() const { return world_.trajectory(request_.session, rollout_.robot); }
    const MotionModel& model() const;
    Nanoseconds tick() const { return world_.parts().scene.tickLength; }
    Nanoseconds step() const { return step_; }
    int steps() const { return steps_; }
    const ComparedRollout& rollout() const { return rollout_; }

private:
    using Change = std::function<void(LogWorld::OpenedParts&, std::size_t body)>;
    Poses run(int from, std::uint64_t seed, const Change& change) const;
    Poses withCommands(const std::function<void(Trajectory&)>& edit) const;

    const LogWorld& world_;
    const RolloutRequest& request_;
    const ComparedRollout& rollout_;
    Nanoseconds step_;
    int steps_;
    std::uint64_t seed_;
};

}  // namespace mrose
