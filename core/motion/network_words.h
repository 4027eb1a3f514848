#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "motion/motion_network.h"

namespace mrose {

// The words of a motion network's file that its writer and its readers share.

constexpr std::string_view motionKind = "motion";

/// By NetworkInput::Quantity.
constexpr std::array<std::string_view, 12> quantityNames{
    "velocity_v", "velocity_w",  "robot",      "command_v",    "command_w",    "turn_sense",
    "left_sine",  "left_cosine", "right_sine", "right_cosine", "forward_sine", "forward_cosine"};

/// By NoiseTrait.
constexpr std::array<std::string_view, noiseTraitCount> noiseTraitNames{
    "moving", "distance", "rotation", "unevenness_v", "unevenness_w", "forward", "forward_change", "heading_change"};

/// By ResidualNoise::Axis.
constexpr std::array<std::string_view, 3> noiseAxisNames{"forward", "left", "heading"};

/// By MotionNetwork::Form.
constexpr std::array<std::string_view, 2> formNames{"state", "history"};

/// "command_v 0.1 to 0.2 s before", "robot b".
std::string inputName(const NetworkInput& input);
/// "m/s"; "1" of what has none.
std::string_view inputUnit(const NetworkInput& input);

/// Names and units in the order of the output layer.
std::vector<NetworkVariable> outputVariables(MotionNetwork::Form form);

}  // namespace mrose
