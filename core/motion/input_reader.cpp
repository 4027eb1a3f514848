#include "motion/input_reader.h"

#include <algorithm>
#include <cmath>

#include "motion/portable_math.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;
using Memory = NetworkInput::Memory;

std::size_t commandQuantity(Quantity q) {
    return static_cast<std::size_t>(q) - static_cast<std::size_t>(Quantity::commandV);
}

/// The share of a lagged memory that is older than this many lags is left out: exp(-7) is below a thousandth.
constexpr double lagsRead = 7;

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
      period_(toSeconds(network.period)),
      oldestAge_(0) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        const NetworkInput& input = inputs_[i];
        if (input.memory == Memory::none) continue;
        groupOf(input).members.emplace_back(i, commandQuantity(input.quantity));
        const double oldest =
            input.memory == Memory::mean ? input.oldest : input.deadTime + lagsRead * std::max(input.lag, 0.0);
        oldestAge_ = std::max(oldestAge_, oldest);
        readsWheels_ = readsWheels_ || input.quantity >= Quantity::leftSine;
    }
}

InputReader::MemoryGroup& InputReader::groupOf(const NetworkInput& input) {
    for (MemoryGroup& group : groups_)
        if (group.memory == input.memory && group.from == input.newest && group.to == input.oldest &&
            group.deadTime == input.deadTime && group.lag == input.lag)
            return group;
    return groups_.emplace_back(MemoryGroup{input.memory, input.newest, input.oldest, input.deadTime, input.lag, {}});
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
    const double perQuantum = 1 / wheelPhase_.quantum, arm = wheelPhase_.halfTrack;
    for (const auto& [sine, side] : {std::pair{Quantity::leftSine, -1.0}, std::pair{Quantity::rightSine, 1.0}}) {
        double* sines = pieces.values[commandQuantity(sine)].data();
        double* cosines = pieces.values[commandQuantity(sine) + 1].data();
        for (std::size_t i = 0; i < pieces.count; ++i) {
            const double turns = (v[i] + side * arm * w[i]) * perQuantum;
            sines[i] = sinTurns(turns);
            cosines[i] = cosTurns(turns);
        }
    }
}

void InputReader::readMean(const MemoryGroup& group, const Pieces& pieces, double* row) const {
    std::size_t first = 0;
    while (first + 1 < pieces.count && pieces.ages[first + 1] <= group.from) ++first;
    for (const auto& [input, quantity] : group.members) {
        double sum = 0;
        for (std::size_t i = first; i < pieces.count && pieces.ages[i] < group.to; ++i) {
            const double begin = std::max(pieces.ages[i], group.from), end = std::min(pieces.ages[i + 1], group.to);
            sum += (end - begin) * pieces.values[quantity][i];
        }
        row[input] = sum / (group.to - group.from);
    }
}

/// The part of the lagged command's mean over the period that commands younger than `age` have: the step response of
/// dead time and lag, averaged over the period.
double InputReader::laggedShare(const MemoryGroup& group, double age) const {
    const double late = age - group.deadTime;  // how long the step has been in effect at the period's start
    if (late <= -period_) return 0;
    const double lag = group.lag;
    if (lag <= 0) return late >= 0 ? 1 : (late + period_) / period_;
    if (late >= 0) return 1 - lag / period_ * (1 - decay(period_ / lag)) * decay(late / lag);
    const double seen = late + period_;
    return (seen - lag * (1 - decay(seen / lag))) / period_;
}

void InputReader::readLagged(const MemoryGroup& group, const Pieces& pieces, double* row) const {
    std::array<double, maxPieces> shares;
    double younger = 0;  // commands not issued yet count as the newest one
    for (std::size_t i = 0; i < pieces.count; ++i) {
        const double share = i + 1 == pieces.count ? 1 : laggedShare(group, pieces.ages[i + 1]);
        shares[i] = share - younger;
        younger = share;
    }
    for (const auto& [input, quantity] : group.members) {
        double sum = 0;
        for (std::size_t i = 0; i < pieces.count; ++i) sum += shares[i] * pieces.values[quantity][i];
        row[input] = sum;
    }
}

void InputReader::readRaw(const MotionInput& input, int robot, double* row) const {
    Pieces pieces;
    collect(input, pieces);
    for (const MemoryGroup& group : groups_)
        group.memory == Memory::mean ? readMean(group, pieces, row) : readLagged(group, pieces, row);
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        if (inputs_[i].memory != Memory::none) continue;
        if (inputs_[i].quantity == Quantity::velocityV) row[i] = input.velocity.v;
        if (inputs_[i].quantity == Quantity::velocityW) row[i] = input.velocity.w;
        if (inputs_[i].quantity == Quantity::robot)
            row[i] = robot < 0 ? inputs_[i].mean : robots_[robot] == inputs_[i].robot;
    }
}

void InputReader::read(const MotionInput& input, int robot, float* row) const {
    std::array<double, MotionNetwork::maxInputs> raw;
    readRaw(input, robot, raw.data());
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        row[i] = static_cast<float>((raw[i] - inputs_[i].mean) / inputs_[i].scale);
}

}  // namespace mrose
