#include "logs/csv_writer.h"

#include <cassert>
#include <charconv>
#include <cmath>

#include "io/file.h"
#include "logs/csv_format.h"

namespace mrose {
namespace {

void append(std::string& text, double number) {
    assert(std::isfinite(number));
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

/// Seconds with as many decimals as are needed.
void append(std::string& text, Nanoseconds time) {
    const bool negative = time < 0;
    const auto magnitude = negative ? 0 - static_cast<std::uint64_t>(time) : static_cast<std::uint64_t>(time);
    constexpr auto second = static_cast<std::uint64_t>(nanosecondsPerSecond);
    std::string fraction = std::to_string(second + magnitude % second);  // a leading 1 keeps the zeros
    fraction.erase(fraction.find_last_not_of('0') + 1);
    if (negative) text += '-';
    text += std::to_string(magnitude / second);
    if (fraction.size() > 1) text.append(".").append(fraction, 1);
}

/// Which of the optional columns say something.
struct Labels {
    bool robot = false, trajectory = false, group = false;
};

Labels labelsOf(const Log& log) {
    Labels labels;
    for (const RobotLog& robot : log.robots) {
        labels.robot = labels.robot || log.robots.size() > 1 || robot.robot != defaultRobot;
        int index = 0;
        for (const Trajectory& trajectory : robot.trajectories) {
            labels.trajectory =
                labels.trajectory || robot.trajectories.size() > 1 || trajectory.name != defaultTrajectory;
            labels.group = labels.group || trajectory.group != index++;
        }
    }
    return labels;
}

void appendRows(std::string& text, const std::string& prefix, const Trajectory& trajectory) {
    const auto& commands = trajectory.commands;
    const auto& poses = trajectory.poses;
    for (std::size_t c = 0, p = 0; c < commands.size() || p < poses.size();) {
        const bool hasCommand = c < commands.size() && (p == poses.size() || commands[c].time <= poses[p].time);
        const bool hasPose = p < poses.size() && (!hasCommand || commands[c].time == poses[p].time);
        text += prefix;
        append(text, hasCommand ? commands[c].time : poses[p].time);
        text += ',';
        if (hasCommand) append(text, commands[c].command.v);
        text += ',';
        if (hasCommand) append(text, commands[c].command.w);
        text += ',';
        if (hasPose) append(text, poses[p].pose.x);
        text += ',';
        if (hasPose) append(text, poses[p].pose.y);
        text += ',';
        if (hasPose) append(text, poses[p].pose.heading);
        text += '\n';
        c += hasCommand;
        p += hasPose;
    }
}

}  // namespace

std::string toCsv(const Log& log) {
    const Labels labels = labelsOf(log);
    std::string text;
    if (log.synthetic) text.append(syntheticMark).append(": no real robot drove\n");
    if (labels.robot) text += "robot,";
    if (labels.trajectory) text += "trajectory,";
    if (labels.group) text += "group,";
    text += "t,v_cmd,w_cmd,x,y,heading\n";
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            std::string prefix;
            if (labels.robot) prefix += robot.robot + ',';
            if (labels.trajectory) prefix += trajectory.name + ',';
            if (labels.group) prefix += std::to_string(trajectory.group) + ',';
            appendRows(text, prefix, trajectory);
        }
    return text;
}

Expected<void> writeCsv(const std::filesystem::path& path, const Log& log) {
    return writeFileAtomically(path, toCsv(log));
}

}  // namespace mrose
