#pragma once

#include <optional>
#include <span>

#include "geometry/pose.h"
#include "world/command_history.h"

namespace mrose {

/// What a motion model sees of one robot at the start of a period.
struct MotionInput {
    CommandView commands;
    Nanoseconds start = 0;  ///< of the predicted period; no command issued after it is read
    Velocity velocity;      ///< at `start`
    /// The MotionStep::unperturbed of the period before: what differs from it has been pushed, and recovers. Unknown at
    /// a first period: the model then tells it from the commands.
    std::optional<Velocity> unperturbed = std::nullopt;
};

/// What it predicts.
struct MotionStep {
    Pose increment;     ///< pose at the period's end in the robot's frame at its start
    Velocity velocity;  ///< at the period's end
    /// The velocity at the period's end that the commands alone lead to, for models that tell it from `velocity`; equal
    /// to it for the others. Part of a robot's state, like its velocity.
    Velocity unperturbed;
};

/// Where one robot will be a control period later: Delta: (v, w, commands) -> (dx, dy, dphi, v', w'). Models are const
/// and remember nothing; dead time is theirs, applied to the issue times in the command history.
class MotionModel {
public:
    virtual ~MotionModel() = default;

    virtual Nanoseconds period() const = 0;

    /// How far before a period's start it reads commands: what a history must keep.
    virtual Nanoseconds memory() const = 0;

    /// From a command's issue to its effect, as it was identified: what a debugger shows. Nothing computes with it.
    struct DeadTimes {
        Nanoseconds v = 0, w = 0;
        bool operator==(const DeadTimes&) const = default;
    };
    virtual DeadTimes deadTimes() const { return {}; }

    /// steps[i] from inputs[i]; the spans have equal sizes. The result for a robot does not depend on the others in the
    /// batch, to the last bit. Inputs must be finite.
    virtual void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const = 0;

    MotionStep predictOne(const MotionInput& input) const {
        MotionStep step;
        predict({&input, 1}, {&step, 1});
        return step;
    }
};

}  // namespace mrose
