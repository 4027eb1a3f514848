#pragma once

#include <array>
#include <span>
#include <string_view>

#include "motion/motion_network.h"

namespace mrose {

/// The words of a network file that its writer and its reader share.
constexpr std::string_view networkFormat = "mrose motion network";

/// By NetworkInput::Quantity.
constexpr std::array<std::string_view, 12> quantityNames{
    "velocity_v", "velocity_w",  "robot",      "command_v",    "command_w",    "turn_sense",
    "left_sine",  "left_cosine", "right_sine", "right_cosine", "forward_sine", "forward_cosine"};

/// By MotionNetwork::Form.
constexpr std::array<std::string_view, 2> formNames{"state", "history"};

constexpr std::array<std::string_view, 5> stateOutputs{"dx_m", "dy_m", "dphi_rad", "end_v_mps", "end_w_radps"};
constexpr std::array<std::string_view, 7> historyOutputs{"dx_m",          "dy_m",      "dphi_rad",   "start_v_mps",
                                                         "start_w_radps", "end_v_mps", "end_w_radps"};

/// With their units, in the order of the output layer.
constexpr std::span<const std::string_view> outputNames(MotionNetwork::Form form) {
    if (form == MotionNetwork::Form::state) return stateOutputs;
    return historyOutputs;
}

}  // namespace mrose
