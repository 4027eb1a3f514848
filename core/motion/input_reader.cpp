#include "motion/input_reader.h"

#include <algorithm>
#include <cmath>

#include "motion/portable_math.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;

std::size_t commandQuantity(Quantity q) {
    return static_cast<std::size_t>(q) - static_cast<std::size_t>(Quantity::commandV);
}

double turnSense(const Command& command, double offset) {
    const bool straight = command.w == 0 && !std::signbit(command.w);
    if (command.v <= 0 || straight) return 0;
    return command.w > offset ? 1 : -1;
}

}  // namespace

InputReader::InputReader(const MotionNetwork& network)
    : inputs_(network.inputs),
      robots_(network.robots),
      wheelPhase_(network.wheelPhase),
      turnOffset_(network.turnOffset),
      oldestAge_(0) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        const NetworkInput& input = inputs_[i];
        if (!input.fromCommands()) continue;
        commandInputs_.push_back({i, commandQuantity(input.quantity), input.newest, input.oldest});
        oldestAge_ = std::max(oldestAge_, input.oldest);
        readsWheels_ = readsWheels_ || input.fromWheels();
    }
}

int InputReader::robotIndex(const std::string& name) const {
    const auto found = std::find(robots_.begin(), robots_.end(), name);
    return found == robots_.end() ? -1 : static_cast<int>(found - robots_.begin());
}

void InputReader::collect(const MotionInput& input, Pieces& pieces) const {
    const CommandHistory& history = *input.commands;
    std::size_t index = history.size();
    while (index > 0 && history.issueTime(index - 1) > input.start) --index;
    pieces.count = 0;
    pieces.ages[0] = 0;
    for (double age = 0; age < oldestAge_; --index) {
        const Command command = index == 0 ? history.beforeFirst() : history.command(index - 1);
        age = index == 0 ? oldestAge_ : toSeconds(input.start - history.issueTime(index - 1));
        pieces.values[commandQuantity(Quantity::commandV)][pieces.count] = command.v;
        pieces.values[commandQuantity(Quantity::commandW)][pieces.count] = command.w;
        pieces.values[commandQuantity(Quantity::turnSense)][pieces.count] = turnSense(command, turnOffset_);
        pieces.ages[++pieces.count] = age;
    }
    if (readsWheels_) addWheelPhases(pieces);
}

void InputReader::addWheelPhases(Pieces& pieces) const {
    const double* v = pieces.values[commandQuantity(Quantity::commandV)].data();
    const double* w = pieces.values[commandQuantity(Quantity::commandW)].data();
    const auto add = [&](Quantity sine, double arm, double quantum) {
        double* sines = pieces.values[commandQuantity(sine)].data();
        double* cosines = pieces.values[commandQuantity(sine) + 1].data();
        for (std::size_t i = 0; i < pieces.count; ++i) {
            const double turns = (v[i] + arm * w[i]) / quantum;
            sines[i] = sinTurns(turns);
            cosines[i] = cosTurns(turns);
        }
    };
    add(Quantity::leftSine, -wheelPhase_.halfTrack, wheelPhase_.quantum);
    add(Quantity::rightSine, wheelPhase_.halfTrack, wheelPhase_.quantum);
    add(Quantity::forwardSine, 0, 2 * wheelPhase_.quantum);
}

void InputReader::readRaw(const MotionInput& input, int robot, double* row) const {
    Pieces pieces;
    collect(input, pieces);
    for (const auto& [index, quantity, newest, oldest] : commandInputs_) {
        const double* values = pieces.values[quantity].data();
        std::size_t i = 0;
        while (i + 1 < pieces.count && pieces.ages[i + 1] <= newest) ++i;
        double sum = 0;
        for (; i < pieces.count && pieces.ages[i] < oldest; ++i)
            sum += (std::min(pieces.ages[i + 1], oldest) - std::max(pieces.ages[i], newest)) * values[i];
        row[index] = sum / (oldest - newest);
    }
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        if (inputs_[i].quantity == Quantity::velocityV) row[i] = input.velocity.v;
        if (inputs_[i].quantity == Quantity::velocityW) row[i] = input.velocity.w;
        if (inputs_[i].quantity == Quantity::robot)
            row[i] = robot < 0 ? inputs_[i].mean : robots_[std::size_t(robot)] == inputs_[i].robot;
    }
}

void InputReader::read(const MotionInput& input, int robot, float* row) const {
    std::array<double, MotionNetwork::maxInputs> raw;
    readRaw(input, robot, raw.data());
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        row[i] = static_cast<float>((raw[i] - inputs_[i].mean) / inputs_[i].scale);
}

}  // namespace mrose
