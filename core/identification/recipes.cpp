#include "identification/recipes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;

NetworkInput meanOf(Quantity quantity, double newest, double oldest) {
    NetworkInput input;
    input.quantity = quantity;
    input.newest = newest;
    input.oldest = oldest;
    return input;
}

double roundedTo5ms(double seconds) { return std::round(seconds * 200) / 200; }

/// Edges of the bins, s before the period's start. They are finest where a command begins to act, and reach back until
/// the lag has forgotten it.
std::vector<double> binEdges(const ResponseTimes& times) {
    const double deadTime = roundedTo5ms(std::min(times.deadTimeV, times.deadTimeW));
    const double spread = std::abs(times.deadTimeV - times.deadTimeW);
    // Drives settle for longer than a lag says.
    const double reach = std::max(0.8, spread + 1.5 * std::max(times.lagV, times.lagW));
    std::vector<double> edges;
    for (const double offset :
         {-0.05, 0.0, 0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2, 0.25, 0.3, 0.4, 0.5, 0.7, 1.0, 1.4}) {
        const double edge = std::max(0.0, deadTime + offset);
        if (!edges.empty() && (edge <= edges.back() || (offset > 0.3 && edges.back() - deadTime >= reach))) continue;
        edges.push_back(edge);
    }
    return edges;
}

MotionNetwork blueprint(const RobotTraits& traits, std::vector<std::string> robots) {
    MotionNetwork network;
    network.robotType = traits.type;
    network.robots = std::move(robots);
    network.wheelPhase = traits.wheelPhase;
    network.turnOffset = traits.turnOffset;
    return network;
}

/// Form state with the velocity among its inputs.
MotionNetwork statePart(const RobotTraits& traits, std::vector<std::string> robots) {
    MotionNetwork network = blueprint(traits, std::move(robots));
    network.form = MotionNetwork::Form::state;
    network.inputs.resize(2);
    network.inputs[0].quantity = Quantity::velocityV;
    network.inputs[1].quantity = Quantity::velocityW;
    return network;
}

}  // namespace

MotionNetwork historyBlueprint(const RobotTraits& traits, std::vector<std::string> robots, const ResponseTimes& times) {
    MotionNetwork network = blueprint(traits, std::move(robots));
    network.form = MotionNetwork::Form::history;
    network.recovery = {times.recoveryV, times.recoveryW};
    const std::vector<double> edges = binEdges(times);
    std::vector<Quantity> quantities{Quantity::commandV, Quantity::commandW};
    if (traits.turnsOnTinyCommands) quantities.push_back(Quantity::turnSense);
    for (const Quantity quantity : quantities)
        for (std::size_t i = 0; i + 1 < edges.size(); ++i)
            network.inputs.push_back(meanOf(quantity, edges[i], edges[i + 1]));
    if (traits.wheelPhase.quantum > 0)
        for (const double newest : {edges[1], edges[1] + 0.1})
            for (const Quantity quantity : {Quantity::leftSine, Quantity::leftCosine, Quantity::rightSine,
                                            Quantity::rightCosine, Quantity::forwardSine, Quantity::forwardCosine})
                network.inputs.push_back(meanOf(quantity, newest, newest + 0.1));
    return network;
}

MotionNetwork stateBlueprint(const RobotTraits& traits, std::vector<std::string> robots, const ResponseTimes& times) {
    MotionNetwork network = statePart(traits, std::move(robots));
    const double deadTime = roundedTo5ms(std::min(times.deadTimeV, times.deadTimeW));
    const double newest = std::max(0.0, deadTime - 0.15);
    const double oldest = std::max(times.deadTimeV, times.deadTimeW) + 0.15;
    std::vector<double> edges{newest};
    while (edges.back() < oldest - 0.01) edges.push_back(roundedTo5ms(edges.back() + 0.05));
    network.limits = times.limits;
    // What the velocity does not tell: how far a controller has wound up, where a ramp is that is not known.
    if (times.limits.accelerationV == 0 || times.limits.accelerationW == 0)
        for (const double further : {0.1, 0.2, 0.2, 0.2}) edges.push_back(roundedTo5ms(edges.back() + further));
    for (const Quantity quantity : {Quantity::commandV, Quantity::commandW})
        for (std::size_t i = 0; i + 1 < edges.size(); ++i)
            network.inputs.push_back(meanOf(quantity, edges[i], edges[i + 1]));
    return network;
}

MotionNetwork velocityBlueprint(const RobotTraits& traits, std::vector<std::string> robots,
                                const ResponseTimes& times) {
    MotionNetwork network = statePart(traits, std::move(robots));
    const double begin = std::max(0.2, roundedTo5ms(std::min(times.deadTimeV, times.deadTimeW)));
    const std::array edges{0.0, begin, begin + 0.4, begin + 1.2};
    for (const Quantity quantity : {Quantity::commandV, Quantity::commandW})
        for (std::size_t i = 0; i + 1 < edges.size(); ++i)
            network.inputs.push_back(meanOf(quantity, edges[i], edges[i + 1]));
    return network;
}

MotionNetwork paperBlueprint(const RobotTraits& traits, std::vector<std::string> robots, const ResponseTimes& times) {
    MotionNetwork network = statePart(traits, std::move(robots));
    const double period = toSeconds(network.period);
    const auto command = [&](Quantity quantity, double deadTime) {
        const double oldest = std::max(roundedTo5ms(deadTime), 0.02);
        network.inputs.push_back(meanOf(quantity, std::max(0.0, oldest - period), oldest));
    };
    command(Quantity::commandV, times.deadTimeV);
    command(Quantity::commandW, times.deadTimeW);
    return network;
}

}  // namespace mrose
