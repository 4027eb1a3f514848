#include "motion/network_words.h"

#include "io/format.h"

namespace mrose {

std::string inputName(const NetworkInput& input) {
    std::string quantity(quantityNames[static_cast<std::size_t>(input.quantity)]);
    if (input.quantity == NetworkInput::Quantity::robot) return quantity + ' ' + input.robot;
    if (!input.fromCommands()) return quantity;
    return quantity + ' ' + numberText(input.newest) + " to " + numberText(input.oldest) + " s before";
}

std::string_view inputUnit(const NetworkInput& input) {
    switch (input.quantity) {
        case NetworkInput::Quantity::velocityV:
        case NetworkInput::Quantity::commandV:
            return "m/s";
        case NetworkInput::Quantity::velocityW:
        case NetworkInput::Quantity::commandW:
            return "rad/s";
        default:
            return "1";
    }
}

std::vector<NetworkVariable> outputVariables(MotionNetwork::Form form) {
    std::vector<NetworkVariable> outputs{{"dx", "m"}, {"dy", "m"}, {"dphi", "rad"}};
    if (form == MotionNetwork::Form::history) {
        outputs.push_back({"start_v", "m/s"});
        outputs.push_back({"start_w", "rad/s"});
    }
    outputs.push_back({"end_v", "m/s"});
    outputs.push_back({"end_w", "rad/s"});
    return outputs;
}

}  // namespace mrose
