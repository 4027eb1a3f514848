#include "motion/input_reader.h"

#include <algorithm>
#include <cmath>

#include "geometry/elementary.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;

double turnSense(const Command& command, double offset) {
    const bool straight = command.w == 0 && !std::signbit(command.w);
    if (command.v <= 0 || straight) return 0;
    return command.w > offset ? 1 : -1;
}

}  // namespace

InputReader::Bins::Bins(const std::vector<NetworkInput>& inputs, Quantity first, Quantity last) {
    for (const NetworkInput& input : inputs) {
        if (input.quantity < first || input.quantity > last) continue;
        oldest_ = std::max(oldest_, input.oldest);
        if (indexOf(input) == bins_.size())
            bins_.push_back({input.newest, input.oldest, 1 / (input.oldest - input.newest)});
    }
    std::sort(bins_.begin(), bins_.end(), [](const Bin& a, const Bin& b) { return a.newest < b.newest; });
}

std::size_t InputReader::Bins::indexOf(const NetworkInput& input) const {
    const auto found = std::find_if(bins_.begin(), bins_.end(), [&](const Bin& bin) {
        return bin.newest == input.newest && bin.oldest == input.oldest;
    });
    return static_cast<std::size_t>(found - bins_.begin());
}

std::pair<std::size_t, std::size_t> InputReader::Bins::reach(const Pieces& pieces) const {
    std::size_t first = 0;
    while (pieces.ages[first + 1] <= bins_.front().newest) ++first;
    std::size_t last = first + 1;
    while (pieces.ages[last] < oldest_) ++last;
    return {first, last};
}

template <std::size_t Width>
double* InputReader::Bins::means(const Pieces& pieces, const double* values, double* means) const {
    std::size_t first = 0;
    for (const Bin& bin : bins_) {
        while (pieces.ages[first + 1] <= bin.newest) ++first;
        std::array<double, Width> sums{};
        double begin = bin.newest;
        for (std::size_t piece = first; begin < bin.oldest; ++piece) {
            const double end = std::min(pieces.ages[piece + 1], bin.oldest);
            const double share = (end - begin) * bin.perLength;
            for (std::size_t q = 0; q < Width; ++q) sums[q] += share * values[piece * Width + q];
            begin = end;
        }
        for (std::size_t q = 0; q < Width; ++q) *means++ = sums[q];
    }
    return means;
}

InputReader::InputReader(const MotionNetwork& network)
    : inputs_(network.inputs),
      robots_(network.robots),
      commands_(inputs_, Quantity::commandV, Quantity::turnSense),
      wheels_(inputs_, Quantity::leftSine, Quantity::forwardCosine),
      limits_(network.limits),
      period_(toSeconds(network.period)),
      oldest_(std::max({commands_.oldest(), wheels_.oldest(), ramps() ? period_ : 0})),
      toldFrom_(ramps() ? std::max(oldest_, std::min(oldest_ + limits_.longestRamp, toSeconds(commandsKnownBefore)))
                        : oldest_),
      halfTrack_(network.wheelPhase.halfTrack),
      perQuantum_(1 / network.wheelPhase.quantum),
      turnOffset_(network.turnOffset),
      readsTurnSense_(std::ranges::any_of(
          inputs_, [](const NetworkInput& input) { return input.quantity == Quantity::turnSense; })) {
    const std::size_t wheels = commandWidth * commands_.size();
    std::size_t others = wheels + wheelWidth * wheels_.size();
    for (const NetworkInput& input : inputs_) {
        const auto after = [&](Quantity first) { return std::size_t(input.quantity) - std::size_t(first); };
        if (input.fromWheels()) {
            places_.push_back(wheels + wheelWidth * wheels_.indexOf(input) + after(Quantity::leftSine));
        } else if (input.fromCommands()) {
            places_.push_back(commandWidth * commands_.indexOf(input) + after(Quantity::commandV));
        } else {
            places_.push_back(others++);
            others_.push_back(input);
        }
        means_.push_back(input.mean);
        inverseScales_.push_back(1 / input.scale);
    }
}

int InputReader::robotIndex(const std::string& name) const {
    const auto found = std::find(robots_.begin(), robots_.end(), name);
    return found == robots_.end() ? -1 : static_cast<int>(found - robots_.begin());
}

/// Returns their number. Nothing is read that was no longer in force `oldest` s ago.
std::size_t InputReader::collect(const MotionInput& input, double oldest, Pieces& pieces) const {
    const CommandView& history = input.commands;
    std::size_t index = history.size();
    while (index > 0 && history.issueTime(index - 1) > input.start) --index;
    double* values = pieces.commands.data();
    double* end = pieces.ages.data();
    *end = 0;
    for (double age = 0; age < oldest; --index, values += commandWidth) {
        const Command command = index == 0 ? history.beforeFirst() : history.command(index - 1);
        age = index == 0 ? oldest : std::min(oldest, toSeconds(input.start - history.issueTime(index - 1)));
        values[0] = command.v;
        values[1] = command.w;
        values[2] = readsTurnSense_ ? turnSense(command, turnOffset_) : 0;
        *++end = age;
    }
    return static_cast<std::size_t>(end - pieces.ages.data());
}

/// Means of v and w, as the drive follows them from `begun` on, where the pieces begin. Returns what it follows where
/// those of the next period do.
Command InputReader::rampMeans(const Pieces& pieces, std::size_t count, const Command& begun, double* means) const {
    RampedCommand ramped(limits_, std::span(pieces.ages.data(), count + 1), pieces.commands.data(), commandWidth,
                         begun);
    for (const Bins::Bin& bin : commands_.bins()) {
        const Command mean = ramped.mean(bin.newest, bin.oldest);
        if (limits_.accelerationV > 0) means[0] = mean.v;
        if (limits_.accelerationW > 0) means[1] = mean.w;
        means += commandWidth;
    }
    return ramped.at(oldest_ - period_);
}

void InputReader::limitWheels(double* means) const {
    for (std::size_t bin = 0; bin < commands_.size(); ++bin, means += commandWidth) {
        const Command within = limits_.withinWheelSpeed({means[0], means[1]});
        means[0] = within.v;
        means[1] = within.w;
    }
}

double* InputReader::wheelMeans(const Pieces& pieces, double* means) const {
    if (wheels_.size() == 0) return means;
    const auto [first, last] = wheels_.reach(pieces);
    std::array<double, maxPieces * wheelWidth> phases;
    double* const begin = &phases[first * wheelWidth];
    double* end = begin;
    for (std::size_t i = first; i < last; ++i) {
        const double v = pieces.commands[i * commandWidth], across = halfTrack_ * pieces.commands[i * commandWidth + 1];
        for (const double turns : {(v - across) * perQuantum_, (v + across) * perQuantum_, v * (perQuantum_ / 2)}) {
            *end++ = turns;
            *end++ = turns + 0.25;
        }
    }
    // One loop over all of them, so that the compiler computes several sines at once.
    std::transform(begin, end, begin, sinTurns);
    return wheels_.means<wheelWidth>(pieces, phases.data(), means);
}

InputReader::Followed InputReader::followedFrom(const CommandView& commands, Nanoseconds start) const {
    Pieces pieces;
    const MotionInput input{commands, start, {}};
    const std::size_t count = collect(input, std::max(toldFrom_, toSeconds(commandsKnownBefore)), pieces);
    const double* const oldest = &pieces.commands[(count - 1) * commandWidth];
    const RampedCommand ramped(limits_, std::span(pieces.ages.data(), count + 1), pieces.commands.data(), commandWidth,
                               {oldest[0], oldest[1]});
    return {ramped.at(oldest_), beginOf(input)};
}

void InputReader::compute(const MotionInput& input, int robot, Followed* followed, Values& values) const {
    Pieces pieces;
    const Nanoseconds begin = beginOf(input);
    const bool known = followed != nullptr && followed->time == begin;
    const std::size_t count = collect(input, known ? oldest_ : toldFrom_, pieces);
    double* value = commands_.means<commandWidth>(pieces, pieces.commands.data(), values.data());
    if (ramps()) {
        const double* const oldest = &pieces.commands[(count - 1) * commandWidth];
        const Command begun = known ? followed->command : Command{oldest[0], oldest[1]};
        const Command next = rampMeans(pieces, count, begun, values.data());
        if (followed != nullptr) *followed = {next, begin + fromSeconds(period_)};
    }
    if (limits_.wheelSpeed > 0) limitWheels(values.data());
    value = wheelMeans(pieces, value);
    for (const NetworkInput& other : others_) {
        if (other.quantity == Quantity::velocityV) *value = input.velocity.v;
        if (other.quantity == Quantity::velocityW) *value = input.velocity.w;
        if (other.quantity == Quantity::robot)
            *value = robot < 0 ? other.mean : robots_[std::size_t(robot)] == other.robot;
        ++value;
    }
}

void InputReader::readRaw(const MotionInput& input, int robot, double* row, Followed* followed) const {
    Values values;
    compute(input, robot, followed, values);
    for (std::size_t i = 0; i < places_.size(); ++i) row[i] = values[places_[i]];
}

void InputReader::read(const MotionInput& input, int robot, float* row, Followed* followed) const {
    Values values;
    compute(input, robot, followed, values);
    for (std::size_t i = 0; i < places_.size(); ++i)
        row[i] = static_cast<float>((values[places_[i]] - means_[i]) * inverseScales_[i]);
}

}  // namespace mrose
