#pragma once

#include <algorithm>
#include <cmath>

#include "assessment/evaluate.h"
#include "motion/motion_model.h"
#include "support/units.h"

namespace mrose {

/// Velocity = the command issued last, an arc per period; `gain` times it where the model shall be wrong.
class HeldCommandModel : public MotionModel {
public:
    explicit HeldCommandModel(Nanoseconds period = 100'000'000, double gain = 1) : period_(period), gain_(gain) {}

    Nanoseconds period() const override { return period_; }
    Nanoseconds lookBack() const override { return 0; }
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override {
        for (std::size_t i = 0; i < inputs.size(); ++i) steps[i] = step(inputs[i]);
    }

protected:
    virtual MotionStep step(const MotionInput& input) const {
        const Command c = input.commands.at(input.start);
        const double t = toSeconds(period_);
        return {exp({gain_ * c.v * t, 0, c.w * t}), {gain_ * c.v, c.w}};
    }

private:
    Nanoseconds period_;
    double gain_;
};

inline Command straightOn(double) { return {0.1, 0}; }

/// A robot that does at once what it is told: at `rate` poses and 10 commands a second, from `from` on for `duration`.
template <class CommandAt>
Trajectory obedientTrajectory(Nanoseconds from, Nanoseconds duration, CommandAt commandAt, int rate = 50) {
    Trajectory trajectory;
    trajectory.name = std::string{"a"};
    Pose pose{1, -2, 0.3};
    Command inForce;
    const Nanoseconds between = second / rate, commandPeriod = second / 10;
    for (Nanoseconds t = 0; t <= duration; t += between) {
        if (t % commandPeriod == 0) {
            inForce = commandAt(toSeconds(t));
            trajectory.commands.push_back({from + t, inForce});
        }
        trajectory.poses.push_back({from + t, pose});
        pose = pose * exp({inForce.v * toSeconds(between), 0, inForce.w * toSeconds(between)});
    }
    return trajectory;
}

inline Log logOf(std::vector<Trajectory> trajectories) {
    return {"made-up", "csv", 0, {{"r", std::move(trajectories), {}}}, {}};
}

}  // namespace mrose
