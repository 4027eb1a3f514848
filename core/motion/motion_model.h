#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geometry/pose.h"
#include "geometry/tracker_offset.h"
#include "world/command_history.h"
#include "world/memory.h"
#include "world/noise.h"

namespace mrose {

/// So much of the commands before they begin do rollouts and worlds of logs know. No model should read farther back.
constexpr Nanoseconds commandsKnownBefore = 3 * nanosecondsPerSecond;

/// What a motion model sees of one robot at the start of a period.
struct MotionInput {
    CommandView commands;
    Nanoseconds start = 0;  ///< of the predicted period; no command issued after it is read
    Velocity velocity;      ///< at `start`
    /// What the model remembers of the robot: memorySize() bytes, read and written. Empty: it begins here, and nothing
    /// is kept.
    std::span<std::byte> memory = {};
    /// Of what is drawn for this robot in this period. nullopt: nothing is random, and the mean is wanted.
    std::optional<NoiseKey> noise = std::nullopt;

    /// For the `draw`-th draw of a model, where anything is random.
    NoiseKey key(std::uint32_t draw) const {
        NoiseKey key = *noise;
        key.channel += draw + 1;  // the first is NoisyModel's, which may be around any other
        return key;
    }
};

/// What it predicts.
struct MotionStep {
    Pose increment;     ///< pose at the period's end in the robot's frame at its start
    Velocity velocity;  ///< at the period's end
};

/// How unsure a model is of a prediction: standard deviations of what it predicts.
struct MotionSpread {
    Pose increment;
    Velocity velocity;
    bool operator==(const MotionSpread&) const = default;
};

/// Where one robot will be a control period later: Delta: (v, w, commands) -> (dx, dy, dphi, v', w'). Models are const;
/// what one remembers of a robot lies in the world's state. Dead time is theirs, applied to the issue times in the
/// command history.
class MotionModel {
public:
    virtual ~MotionModel() = default;

    virtual Nanoseconds period() const = 0;

    /// How far before a period's start it reads commands: what a history must keep.
    virtual Nanoseconds lookBack() const = 0;

    /// Bytes that it remembers of each robot, constant; multiples of 8 lie aligned for anything.
    virtual std::size_t memorySize() const { return 0; }
    /// Fills the memory at a run's start. All zero before.
    virtual void start(std::span<std::byte> /*memory*/) const {}
    /// The same of a robot that was set down elsewhere: what it was doing is forgotten.
    virtual void restart(std::span<std::byte> memory) const {
        std::fill(memory.begin(), memory.end(), std::byte{0});
        start(memory);
    }
    /// Tells a memory at a run's start what was seen of its robot before, beyond what this model expects: what is
    /// predicted then is where its tracked point will be. Models that know of no such point leave it.
    virtual void adapt(std::span<std::byte> /*memory*/, const TrackerEvidence& /*seen*/) const {}
    /// Tells a memory at a run's start, which is `start`, what its robot was sent before, also farther back than
    /// lookBack(). Models that need no more leave it.
    virtual void recall(std::span<std::byte> /*memory*/, const CommandView& /*sent*/, Nanoseconds /*start*/) const {}
    /// What such a memory says.
    virtual void explain(std::span<const std::byte> /*memory*/, MemoryEntries& /*entries*/) const {}

    /// From a command's issue to its effect, as it was identified: what a debugger shows. Nothing computes with it.
    struct DeadTimes {
        Nanoseconds v = 0, w = 0;
        bool operator==(const DeadTimes&) const = default;
    };
    virtual DeadTimes deadTimes() const { return {}; }

    /// The model that this one only adds something to; otherwise itself.
    virtual const MotionModel& underlying() const { return *this; }

    /// Whether it predicts the same of everything as one that was made otherwise, as far as their parameters tell.
    virtual bool sameAs(const MotionModel& other) const { return this == &other; }

    /// steps[i] from inputs[i]; the spans have equal sizes. The result for a robot does not depend on the others in the
    /// batch, to the last bit. Inputs must be finite.
    virtual void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const = 0;

    /// The same steps, with how unsure the model is of each: zero of models that do not know.
    virtual void predictWithSpread(std::span<const MotionInput> inputs, std::span<MotionStep> steps,
                                   std::span<MotionSpread> spreads) const {
        predict(inputs, steps);
        std::fill(spreads.begin(), spreads.end(), MotionSpread{});
    }

    MotionStep predictOne(const MotionInput& input) const {
        MotionStep step;
        predict({&input, 1}, {&step, 1});
        return step;
    }
};

}  // namespace mrose
