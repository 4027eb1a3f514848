#pragma once

#include "motion/motion_model.h"

namespace mrose {

/// Differential-drive kinematics with what a real drive adds. By default velocity = command.
struct KinematicParameters {
    struct Channel {
        double deadTime = 0;  ///< s, from issue to effect
        double lag = 0;       ///< s, time constant of the first-order approach to the commanded velocity
        double gain = 1;      ///< steady velocity per command
        double bias = 0;      ///< steady velocity at command 0 while the other channel moves the robot; m/s or rad/s
        double limit = 0;     ///< largest |velocity|, m/s or rad/s; 0: none
        double acceleration = 0;  ///< largest |change of velocity|, m/s2 or rad/s2; 0: none
        bool operator==(const Channel&) const = default;
    };
    Channel v, w;
    double lateralPerRotation = 0;  ///< m: sideways shift per radian, of a tracked point ahead of the axle
    bool operator==(const KinematicParameters&) const = default;
};

/// Kinematics integrated along the commands' own switching times within the period: velocities follow the delayed
/// command exactly where it is constant, and the pose follows the arc of each such piece.
class KinematicModel final : public MotionModel {
public:
    explicit KinematicModel(const KinematicParameters& parameters, Nanoseconds period = 100'000'000)
        : parameters_(parameters), period_(period) {}

    Nanoseconds period() const override { return period_; }
    Nanoseconds lookBack() const override;
    bool sameAs(const MotionModel& other) const override;
    DeadTimes deadTimes() const override {
        return {fromSeconds(parameters_.v.deadTime), fromSeconds(parameters_.w.deadTime)};
    }
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override;
    const KinematicParameters& parameters() const { return parameters_; }

private:
    MotionStep step(const MotionInput& input) const;

    KinematicParameters parameters_;
    Nanoseconds period_;
};

}  // namespace mrose
