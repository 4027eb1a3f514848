#include "logs/csv_writer.h"

#include <array>
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
    bool readings = false, reported = false, scans = false;
    bool kicks = false, ball = false;

    bool sensors() const { return readings || reported || scans; }
};

void addReports(Labels& labels, const Trajectory& trajectory) {
    for (const SensorLog& sensor : trajectory.sensors) {
        labels.readings = labels.readings || !sensor.looks.empty();
        labels.reported = labels.reported || !sensor.poses.empty();
        labels.scans = labels.scans || !sensor.scans.empty();
    }
}

Labels labelsOf(const Log& log) {
    Labels labels;
    labels.readings = !log.subjects.empty();
    for (const LogSubject& subject : log.subjects)
        labels.robot = labels.robot || subject.kind == LogSubject::Kind::robot;
    for (const RobotLog& robot : log.robots) {
        labels.robot = labels.robot || log.robots.size() > 1 || robot.robot != defaultRobot;
        int index = 0;
        for (const Trajectory& trajectory : robot.trajectories) {
            labels.trajectory =
                labels.trajectory || robot.trajectories.size() > 1 || trajectory.name != defaultTrajectory;
            labels.group = labels.group || trajectory.group != index++;
            labels.kicks = labels.kicks || !trajectory.kicks.empty();
            labels.ball = labels.ball || !trajectory.ball.empty();
            addReports(labels, trajectory);
        }
    }
    return labels;
}

/// The cells of a row beside commands and poses, in the order of the columns but for the last, which come first; ""
/// where it has none.
struct ReportCells {
    std::string_view sensor = {}, subject = {};
    std::string range = {}, bearing = {};
    std::array<std::string, 3> reported = {}, scan = {};
    std::string kick = {}, ballX = {}, ballY = {};
};

void appendCells(std::string& text, const Labels& labels, const ReportCells& cells) {
    const auto append = [&](std::string_view cell) { text.append(",").append(cell); };
    if (labels.kicks) append(cells.kick);
    if (labels.ball) append(cells.ballX), append(cells.ballY);
    if (labels.sensors()) append(cells.sensor);
    if (labels.readings)
        for (const std::string_view cell :
             {cells.subject, std::string_view(cells.range), std::string_view(cells.bearing)})
            append(cell);
    if (labels.reported)
        for (const std::string& cell : cells.reported) append(cell);
    if (labels.scans)
        for (const std::string& cell : cells.scan) append(cell);
    text += '\n';
}

std::string cell(double number) {
    std::string text;
    append(text, number);
    return text;
}

std::string rangesText(const std::vector<double>& ranges) {
    std::string text;
    for (const double range : ranges) {
        if (!text.empty()) text += ';';
        if (std::isfinite(range))
            append(text, range);
        else
            text += "inf";
    }
    return text;
}

void appendReport(std::string& text, const std::string& prefix, const Labels& labels, Nanoseconds time,
                  const ReportCells& cells) {
    text += prefix;
    append(text, time);
    text += ",,,,,";
    appendCells(text, labels, cells);
}

void appendSensor(std::string& text, const std::string& prefix, const Labels& labels, const SensorLog& sensor,
                  const std::vector<LogSubject>& subjects) {
    for (const Look& look : sensor.looks) {
        if (look.readings.empty()) appendReport(text, prefix, labels, look.time, {sensor.sensor});
        for (const LogReading& reading : look.readings)
            appendReport(text, prefix, labels, look.time,
                         {sensor.sensor, subjects[reading.subject].name, cell(reading.range), cell(reading.bearing)});
    }
    for (const auto& [time, pose] : sensor.poses)
        appendReport(text, prefix, labels, time,
                     {.sensor = sensor.sensor, .reported = {cell(pose.x), cell(pose.y), cell(pose.heading)}});
    for (const LogScan& scan : sensor.scans)
        appendReport(text, prefix, labels, scan.time,
                     {.sensor = sensor.sensor, .scan = {cell(scan.start), cell(scan.step), rangesText(scan.ranges)}});
}

void appendBall(std::string& text, const std::string& prefix, const Labels& labels, const Trajectory& trajectory) {
    for (const auto& [time, power] : trajectory.kicks) appendReport(text, prefix, labels, time, {.kick = cell(power)});
    for (const auto& [time, place] : trajectory.ball)
        appendReport(text, prefix, labels, time, {.ballX = cell(place.x), .ballY = cell(place.y)});
}

/// Rows without a time: who or where the subjects are.
void appendSubjects(std::string& text, const Labels& labels, const std::vector<LogSubject>& subjects) {
    for (const LogSubject& subject : subjects) {
        if (labels.robot) text += subject.robot + ',';
        if (labels.trajectory) text += ',';
        if (labels.group) text += ',';
        text += ",,,";
        if (subject.position) append(text, subject.position->x);
        text += ',';
        if (subject.position) append(text, subject.position->y);
        text += ',';
        appendCells(text, labels, {.subject = subject.name});
    }
}

void appendRows(std::string& text, const std::string& prefix, const Labels& labels, const Trajectory& trajectory) {
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
        appendCells(text, labels, {});
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
    text += "t,v_cmd,w_cmd,x,y,heading";
    if (labels.kicks) text += ",kick";
    if (labels.ball) text += ",ball_x,ball_y";
    if (labels.sensors()) text += ",sensor";
    if (labels.readings) text += ",subject,range,bearing";
    if (labels.reported) text += ",reported_x,reported_y,reported_heading";
    if (labels.scans) text += ",scan_start,scan_step,scan";
    text += '\n';
    appendSubjects(text, labels, log.subjects);
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            std::string prefix;
            if (labels.robot) prefix += robot.robot + ',';
            if (labels.trajectory) prefix += trajectory.name + ',';
            if (labels.group) prefix += std::to_string(trajectory.group) + ',';
            appendRows(text, prefix, labels, trajectory);
            appendBall(text, prefix, labels, trajectory);
            for (const SensorLog& sensor : trajectory.sensors) appendSensor(text, prefix, labels, sensor, log.subjects);
        }
    return text;
}

Expected<void> writeCsv(const std::filesystem::path& path, const Log& log) {
    return writeFileAtomically(path, toCsv(log));
}

}  // namespace mrose
