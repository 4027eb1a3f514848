#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/pose_region.h"
#include "io/progress.h"
#include "scenario/scenario.h"
#include "simulation/step.h"

namespace mrose {

/// Where the robots of a run may be at ticks from some tick on, by the noise of their motion. A value.
struct MotionBands {
    std::int64_t tick = 0;                         ///< the first
    std::int64_t every = 1;                        ///< ticks from one instant to the next
    std::vector<std::vector<PoseRegion>> regions;  ///< by robot; empty: no noise of its motion is known

    std::int64_t last() const;  ///< the last tick that it has
    bool empty() const { return last() < tick; }
    /// At a tick or the nearest instant before; nullptr: there is none.
    const PoseRegion* at(std::size_t robot, std::int64_t tick) const;
    /// Those of the instants from one tick to another, the one before `from` among them.
    std::span<const PoseRegion> between(std::size_t robot, std::int64_t from, std::int64_t to) const;
    bool operator==(const MotionBands&) const = default;
};

/// Samples what may become of a run: the same world, but that robots whose learned motion is drawn as its mean draw its
/// noise. Where that is drawn anyway, a sample is what step() makes of the state with the sample's seed.
class MotionSampler {
public:
    /// `deciding`: of each robot whether its controller goes on deciding, as one does that plays a log; the others keep
    /// the commands in force.
    MotionSampler(std::shared_ptr<const Scenario> scenario, std::vector<bool> deciding);

    /// Whether any noise of a robot's motion is known: its own, or what its network has learned.
    bool knowsNoise(std::size_t robot) const { return noisy_[robot]; }
    bool knowsAnyNoise() const;
    /// In which samples are drawn; the run's own where nothing is to be changed.
    const Scenario& drawn() const { return *drawn_; }
    /// A state of the run as a sample begins with it.
    WorldState begin(const WorldState& state, std::uint64_t seed) const;
    /// One tick of a sample, or of the run without other noise in its own scenario.
    void step(const Scenario& in, WorldState& state, StepBuffers& buffers) const;

    struct Options {
        Nanoseconds ahead = 5 * nanosecondsPerSecond;
        int samples = 64;
        std::uint64_t seed = 0;                        ///< of the first sample; each has the next one
        Nanoseconds step = nanosecondsPerSecond / 10;  ///< from one instant to the next
    };
    /// nullopt: it did not go on. Errors are those from the run as it goes on with its own seed and draws.
    std::optional<MotionBands> bands(const WorldState& state, const Options& options, const GoesOn& goesOn) const;

private:
    std::shared_ptr<const Scenario> scenario_, drawn_;
    std::vector<bool> noisy_;
    std::vector<RobotDecision> holding_;
    bool allHold_ = true;
};

}  // namespace mrose
