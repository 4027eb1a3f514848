#pragma once

#include "motion/motion_network.h"
#include "world/noise.h"

namespace mrose {

/// A network of either form with arbitrary layers that are small enough to move like a robot.
inline MotionNetwork arbitraryNetwork(MotionNetwork::Form form) {
    using Quantity = NetworkInput::Quantity;
    MotionNetwork n;
    n.form = form;
    n.robotType = "test \"robot\" \\ 1";
    n.robots = {"a", "b"};
    n.wheelPhase = {0.13, 0.0084};
    n.turnOffset = 0.0055;
    if (form == MotionNetwork::Form::state) n.limits = {0.55, 4.7, 0.5, 0.165, 1.5};
    n.recovery = form == MotionNetwork::Form::history ? MotionNetwork::Recovery{0.1, 0.14} : MotionNetwork::Recovery{};
    const auto add = [&](Quantity q, double newest, double oldest) {
        NetworkInput input;
        input.quantity = q;
        input.newest = newest;
        input.oldest = oldest;
        input.mean = 0.01 * static_cast<double>(n.inputs.size());
        input.scale = 0.1 + 0.03 * static_cast<double>(n.inputs.size());
        if (q == Quantity::robot) input.robot = "b";
        n.inputs.push_back(input);
    };
    add(Quantity::velocityV, 0, 0);
    add(Quantity::velocityW, 0, 0);
    add(Quantity::robot, 0, 0);
    for (const Quantity q :
         {Quantity::commandV, Quantity::commandW, Quantity::turnSense, Quantity::leftSine, Quantity::leftCosine,
          Quantity::rightSine, Quantity::rightCosine, Quantity::forwardSine, Quantity::forwardCosine}) {
        add(q, 0, 0.04);
        add(q, 0.1, 0.225);
    }
    const int outputs = n.form == MotionNetwork::Form::state ? 5 : 7;
    for (int k = 0; k < outputs; ++k) n.outputs.push_back({1e-3 * k, 0.01 * (k + 1)});
    n.mlp.shape = {int(n.inputs.size()), 13, outputs};
    for (std::size_t i = 0; i < n.mlp.shape.parameterCount(); ++i)
        n.mlp.parameters.push_back(static_cast<float>(0.3 * normalNoise({5, static_cast<std::int64_t>(i), 0, 0})));
    KinematicParameters delayed, dynamic;
    delayed.v.deadTime = 0.21;
    dynamic.w = {.1, .14, .98, .002, 1.5, 0.7};
    dynamic.lateralPerRotation = -0.004;
    n.identified.push_back({"b", {0.01, -0.02}, {.2, .004, .05, .07}, {.15, .003, .08, .06}, delayed, dynamic});
    n.training = {"mrose train x -o y", "irprop+", "rollout", 7, 1234, 56, {{"x/a.dat", "0123456789abcdef"}}};
    n.heldOut = {321, 10, 1.66, 3.89};
    return n;
}

}  // namespace mrose
