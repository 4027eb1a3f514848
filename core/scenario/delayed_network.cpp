#include "scenario/delayed_network.h"

#include <algorithm>

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;

double shiftOf(const NetworkInput& input, Nanoseconds laterV, Nanoseconds laterW) {
    if (!input.fromCommands()) return 0;
    const bool rotation = input.quantity == Quantity::commandW || input.quantity == Quantity::turnSense;
    return toSeconds(rotation ? laterW : laterV);
}

/// The sense of a turn and the speeds of the wheels are made from both channels.
bool readsBoth(const NetworkInput& input) { return input.fromWheels() || input.quantity == Quantity::turnSense; }

}  // namespace

bool canDelay(const MotionNetwork& network, Nanoseconds laterV, Nanoseconds laterW) {
    return std::all_of(network.inputs.begin(), network.inputs.end(), [&](const NetworkInput& input) {
        if (readsBoth(input) && laterV != laterW) return false;
        return !input.fromCommands() || input.newest + shiftOf(input, laterV, laterW) >= 0;
    });
}

MotionNetwork delayed(MotionNetwork network, Nanoseconds laterV, Nanoseconds laterW) {
    for (NetworkInput& input : network.inputs) {
        const double shift = shiftOf(input, laterV, laterW);
        input.newest += shift;
        input.oldest += shift;
    }
    if (network.familiar) {
        const auto shift = [](FamiliarDriving::Channel& channel, double later) {
            channel.newest += later;
            channel.oldest += later;
        };
        shift(network.familiar->v, toSeconds(laterV));
        shift(network.familiar->w, toSeconds(laterW));
    }
    for (MotionNetwork::Identified& robot : network.identified) {
        robot.v.deadTime += toSeconds(laterV);
        robot.w.deadTime += toSeconds(laterW);
    }
    return network;
}

}  // namespace mrose
