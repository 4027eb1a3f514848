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
        inverseScales_.push_back(1 / input.scale);
        if (!input.fromCommands()) {
            others_.push_back(i);
            continue;
        }
        auto bin = std::find_if(bins_.begin(), bins_.end(),
                                [&](const Bin& b) { return b.newest == input.newest && b.oldest == input.oldest; });
        if (bin == bins_.end()) bin = bins_.insert(bin, {input.newest, input.oldest, {}});
        bin->members.push_back({i, commandQuantity(input.quantity)});
        oldestAge_ = std::max(oldestAge_, input.oldest);
        readsWheels_ = readsWheels_ || input.fromWheels();
    }
}

int InputReader::robotIndex(const std::string& name) const {
    const auto found = std::find(robots_.begin(), robots_.end(), name);
    return found == robots_.end() ? -1 : static_cast<int>(found - robots_.begin());
}

void InputReader::collect(const MotionInput& input, Pieces& pieces) const {
    const CommandView& history = input.commands;
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
    const auto add = [&](Quantity sine, double arm, double perQuantum) {
        double* sines = pieces.values[commandQuantity(sine)].data();
        double* cosines = pieces.values[commandQuantity(sine) + 1].data();
        for (std::size_t i = 0; i < pieces.count; ++i) {
            const double turns = (v[i] + arm * w[i]) * perQuantum;
            sines[i] = sinTurns(turns);
            cosines[i] = cosTurns(turns);
        }
    };
    const double perQuantum = 1 / wheelPhase_.quantum;
    add(Quantity::leftSine, -wheelPhase_.halfTrack, perQuantum);
    add(Quantity::rightSine, wheelPhase_.halfTrack, perQuantum);
    add(Quantity::forwardSine, 0, perQuantum / 2);
}

void InputReader::readBin(const Bin& bin, const Pieces& pieces, double* row) {
    for (const auto& [input, quantity] : bin.members) row[input] = 0;
    std::size_t piece = 0;
    while (piece + 1 < pieces.count && pieces.ages[piece + 1] <= bin.newest) ++piece;
    const double perLength = 1 / (bin.oldest - bin.newest);
    for (; piece < pieces.count && pieces.ages[piece] < bin.oldest; ++piece) {
        const double begin = std::max(pieces.ages[piece], bin.newest);
        const double share = (std::min(pieces.ages[piece + 1], bin.oldest) - begin) * perLength;
        for (const auto& [input, quantity] : bin.members) row[input] += share * pieces.values[quantity][piece];
    }
}

void InputReader::readRaw(const MotionInput& input, int robot, double* row) const {
    Pieces pieces;
    collect(input, pieces);
    for (const Bin& bin : bins_) readBin(bin, pieces, row);
    for (const std::size_t i : others_) {
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
        row[i] = static_cast<float>((raw[i] - inputs_[i].mean) * inverseScales_[i]);
}

}  // namespace mrose
