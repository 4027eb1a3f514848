#include "assessment/manoeuvre.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mrose {
namespace {

constexpr Nanoseconds sampling = 20'000'000;
constexpr Nanoseconds before = 500'000'000;
constexpr std::size_t held = 15, change = 5;  // samples: 0.3 s, 0.1 s
constexpr double full = 0.7, zero = 0.1, opposite = 0.25;
constexpr double turningPerSecond = 0.05;  // rad/s

std::vector<Command> sampled(const Trajectory& trajectory, Nanoseconds from, Nanoseconds to) {
    std::vector<Command> result;
    const auto& commands = trajectory.commands;
    const auto later = std::upper_bound(commands.begin(), commands.end(), from,
                                        [](Nanoseconds t, const StampedCommand& c) { return t < c.time; });
    auto next = static_cast<std::size_t>(later - commands.begin());
    Command inForce;
    if (next > 0)
        inForce = commands[next - 1].command;
    else if (trajectory.steady && !commands.empty())
        inForce = commands.front().command;
    for (Nanoseconds t = from; t < to; t += sampling) {
        while (next < commands.size() && commands[next].time <= t) inForce = commands[next++].command;
        result.push_back(inForce);
    }
    return result;
}

struct Range {
    double least, largest;
};

/// For each i the range of values[i ... i + held).
std::vector<Range> heldRanges(const std::vector<double>& values) {
    std::vector<Range> result;
    for (std::size_t i = 0; i + held <= values.size(); ++i) {
        const auto [least, largest] = std::minmax_element(values.begin() + i, values.begin() + i + held);
        result.push_back({*least, *largest});
    }
    return result;
}

bool switches(const Range& from, const Range& to) {
    const bool fromFull = from.least >= full || from.largest <= -full;
    const bool toZero = std::max(std::abs(to.least), std::abs(to.largest)) <= zero;
    const bool up = from.largest <= -opposite && to.least >= opposite;
    const bool down = from.least >= opposite && to.largest <= -opposite;
    return (fromFull && toZero) || up || down;
}

/// `values` are parts of the channel's largest command.
bool hasHardSwitch(const std::vector<double>& values) {
    const std::vector<Range> ranges = heldRanges(values);
    for (std::size_t i = 0; i + held + change < ranges.size(); ++i)
        if (switches(ranges[i], ranges[i + held + change])) return true;
    return false;
}

bool hasHardSwitch(const std::vector<Command>& commands, double Command::*channel, double scale) {
    if (scale <= 0) return false;
    std::vector<double> values;
    for (const Command& command : commands) values.push_back(command.*channel / scale);
    return hasHardSwitch(values);
}

}  // namespace

std::string_view name(Manoeuvre manoeuvre) {
    switch (manoeuvre) {
        case Manoeuvre::straight:
            return "straight";
        case Manoeuvre::turning:
            return "turning";
        case Manoeuvre::hardSwitch:
            break;
    }
    return "hard switch";
}

CommandScale commandScale(const RobotLog& robot) {
    CommandScale scale;
    for (const Trajectory& trajectory : robot.trajectories)
        for (const StampedCommand& stamped : trajectory.commands) {
            scale.v = std::max(scale.v, std::abs(stamped.command.v));
            scale.w = std::max(scale.w, std::abs(stamped.command.w));
        }
    return scale;
}

Manoeuvre classify(const Trajectory& trajectory, Nanoseconds start, Nanoseconds end, const CommandScale& scale) {
    const std::vector<Command> commands = sampled(trajectory, start - before, end);
    if (hasHardSwitch(commands, &Command::v, scale.v) || hasHardSwitch(commands, &Command::w, scale.w))
        return Manoeuvre::hardSwitch;
    double rotation = 0;
    const auto first = commands.begin() + before / sampling;
    for (auto command = first; command != commands.end(); ++command) rotation += std::abs(command->w);
    const bool turns = rotation >= turningPerSecond * static_cast<double>(commands.end() - first);
    return turns ? Manoeuvre::turning : Manoeuvre::straight;
}

}  // namespace mrose
