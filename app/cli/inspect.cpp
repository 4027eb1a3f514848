#include <cstdio>

#include "common.h"
#include "io/format.h"
#include "logs/sensor_defects.h"
#include "report/program_json.h"
#include "workflow/inspect_log.h"

namespace mrose::cli {
namespace {

std::string rangeText(const MeasuredRange& range, int decimals) {
    return range.empty() ? "none" : fixed(range.least, decimals) + " to " + fixed(range.most, decimals);
}

std::string channelText(const ChannelDelay& c) {
    if (!c.identified) return "not identified: " + c.reason;
    return "dead time " + fixed(1000 * c.deadTime, 0) + " ± " + fixed(1000 * c.deadTimeError, 0) + " ms, lag " +
           fixed(1000 * c.lag, 0) + " ± " + fixed(1000 * c.lagError, 0) + " ms, jitter " + fixed(1000 * c.jitter, 0) +
           " ms (" + c.quality() + "; explains " + fixed(100 * c.explained, 1) + " % of the motion)";
}

std::string reportsText(const SensorInspection& sensor) {
    std::vector<std::string> parts;
    if (sensor.looks > 0) {
        std::string looks = counted(sensor.looks, "look");
        if (const std::size_t empty = sensor.looks - sensor.seeingLooks; empty > 0)
            looks += ", " + std::to_string(empty) + " of them empty";
        parts.push_back(looks);
    }
    if (sensor.readings > 0) {
        const auto readings = static_cast<double>(sensor.readings);
        parts.push_back(counted(sensor.readings, "reading") + " of " + counted(sensor.subjects, "subject") + " (" +
                        fixed(100 * static_cast<double>(sensor.landmarkReadings) / readings, 0) + " % landmarks), " +
                        fixed(readings / static_cast<double>(sensor.seeingLooks), 1) + " a look");
    }
    if (sensor.poses > 0) parts.push_back(counted(sensor.poses, "reported pose"));
    if (sensor.scans > 0) parts.push_back(counted(sensor.scans, "scan"));
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
    return text;
}

std::string timesText(const SensorInspection& sensor) {
    std::string text;
    if (sensor.period > 0) text = "every " + fixed(sensor.period, 3) + " ± " + fixed(sensor.periodSpread, 3) + " s; ";
    if (!sensor.lateness.identified) return text + "lateness not identified: " + sensor.lateness.reason;
    const int digits = sensor.lateness.error < 0.001 ? 1 : 0;
    return text + "late by " + fixed(1000 * sensor.lateness.lateness, digits) + " ± " +
           fixed(1000 * sensor.lateness.error, digits) + " ms";
}

std::string truthText(const SensorInspection& sensor) {
    if (sensor.gross == sensor.known) return "off the ground truth: all of them gross (beyond 1 m or 0.15 rad)";
    return "off the ground truth: range " + fixed(1000 * sensor.rangeOffset, 0) + " ± " +
           fixed(1000 * sensor.rangeSpread, 0) + " mm, bearing " + fixed(1000 * sensor.bearingOffset, 1) + " ± " +
           fixed(1000 * sensor.bearingSpread, 1) + " mrad; " + fixed(100 * sensor.grossShare(), 2) +
           " % gross (beyond 1 m or 0.15 rad)";
}

std::string changeText(const SensorChange& change) {
    if (!change.bearing)
        return "range " + fixed(100 * change.offset, 1) + " ± " + fixed(100 * change.error, 1) + " % off";
    const std::string off =
        "bearing " + fixed(1000 * change.offset, 0) + " ± " + fixed(1000 * change.error, 0) + " mrad off";
    const std::string heading = "by its motion, its tracked heading " + fixed(1000 * change.headingOffset, 0) + " ± " +
                                fixed(1000 * change.headingError, 0) + ": ";
    if (change.cause == SensorChange::Cause::truth)
        return off + "; " + heading + "the ground truth changed, not the sensor";
    if (change.cause == SensorChange::Cause::sensor) return off + "; " + heading + "the sensor changed";
    return off + ": sensor or ground truth, its motion does not say";
}

void printSensor(const SensorInspection& sensor, std::size_t trajectories) {
    const std::string name = sensor.sensor + std::string(sensor.sensor.size() < 9 ? 9 - sensor.sensor.size() : 0, ' ');
    std::printf("  %s %s\n            %s\n", name.c_str(), reportsText(sensor).c_str(), timesText(sensor).c_str());
    if (sensor.known > 0) std::printf("            %s\n", truthText(sensor).c_str());
    if (sensor.pose.poses > 0)
        std::printf("            off the ground truth: %s m and %s deg in the median\n",
                    fixed(sensor.pose.distance, 3).c_str(), fixed(degrees * sensor.pose.heading, 1).c_str());
    if (sensor.pose.looksExchanged()) std::printf("  Note: %s\n", exchangedText(sensor.pose).c_str());
    for (const SensorDefectCount& count : sensorDefectCounts()) {
        const std::int64_t found = sensor.defects.*count.count;
        if (found > 0)
            std::printf("  found     %lld %s%s\n", static_cast<long long>(found), found == 1 ? count.one : count.many,
                        count.done);
    }
    for (const SensorChange& change : sensor.changes)
        std::printf("  changed   %s to %s s%s: %s\n", fixed(change.begin, 1).c_str(), fixed(change.end, 1).c_str(),
                    trajectories > 1 ? (" of trajectory " + change.trajectory).c_str() : "",
                    changeText(change).c_str());
}

void printRobot(const RobotInspection& robot) {
    std::printf("\nrobot %s%s\n", robot.robot.c_str(),
                robot.trajectories > 1 ? (", " + std::to_string(robot.trajectories) + " trajectories").c_str() : "");
    std::printf("  commands  %zu in %s s (%s Hz), v %s m/s, w %s rad/s\n", robot.commands,
                fixed(robot.commandTime, 1).c_str(), fixed(robot.commandRate(), 1).c_str(),
                rangeText(robot.v, 3).c_str(), rangeText(robot.w, 3).c_str());
    if (robot.poses == 0)
        std::puts("  poses     none: the log has no ground truth of it");
    else
        std::printf("  poses     %zu in %s s (%s Hz), x %s m, y %s m\n", robot.poses, fixed(robot.poseTime, 1).c_str(),
                    fixed(robot.poseRate(), 1).c_str(), rangeText(robot.x, 2).c_str(), rangeText(robot.y, 2).c_str());
    if (robot.ball > 0)
        std::printf("  ball      %zu in %s s (%s Hz)\n", robot.ball, fixed(robot.ballTime, 1).c_str(),
                    fixed(robot.ballRate(), 1).c_str());
    if (robot.kicks > 0) std::printf("  kicks     %zu, power %s\n", robot.kicks, rangeText(robot.kickPower, 2).c_str());
    const LogDefects& d = robot.defects;
    for (const DefectCount& count : defectCounts()) {
        const std::int64_t found = d.*count.count;
        if (found == 0) continue;
        const double longest = count.count == &LogDefects::commandGaps ? d.longestCommandGap
                               : count.count == &LogDefects::poseGaps  ? d.longestPoseGap
                               : count.count == &LogDefects::ballGaps  ? d.longestBallGap
                                                                       : 0;
        std::printf("  found     %lld %s%s%s\n", static_cast<long long>(found), found == 1 ? count.one : count.many,
                    count.done, longest > 0 ? (", the longest " + fixed(longest, 2) + " s").c_str() : "");
    }
    std::printf("  v         %s\n  w         %s\n", channelText(robot.delays.v).c_str(),
                channelText(robot.delays.w).c_str());
    for (const SensorInspection& sensor : robot.sensors) printSensor(sensor, robot.trajectories);
}

int runInspect(const InspectRequest& request, const CommonFlags& common) {
    const auto log = inspectLog(request);
    if (!log) return report(log.error());
    if (common.json) {
        std::puts(inspectionJson(*log).c_str());
        return success;
    }
    std::printf("%s: %s%s, %s, %s%s\n", log->source.c_str(), log->format.c_str(), log->synthetic ? " (synthetic)" : "",
                counted(log->robots.size(), "robot").c_str(),
                counted(log->files.size() + log->measurementFiles.size(), "file").c_str(),
                log->measurementFiles.empty()
                    ? ""
                    : (", " + std::to_string(log->measurementFiles.size()) + " of them of measurements").c_str());
    for (const auto& notices : {log->incomplete, log->unitDoubts})
        for (const std::string& notice : notices) std::printf("Note: %s\n", notice.c_str());
    if (!log->hasMeasurements()) std::puts("The log holds no measurements: nothing that sensors reported.");
    for (const RobotInspection& robot : log->robots) printRobot(robot);
    if (log->hasMeasurements())
        std::puts(
            "\nOf sensors ± is a robust spread after \"every\" and \"off the ground truth\", and one standard error "
            "after \"late by\" and \"changed\".");
    return success;
}

}  // namespace

Subcommand addInspect(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<InspectRequest>();
    CLI::App* sub =
        addSubcommand(app, common, "inspect",
                      "Say what a log holds: robots, rates, gaps, ranges, dead times, sensors, and what was mended",
                      "  mrose inspect MRCLAM_Dataset6\n"
                      "  mrose inspect husky_windows.csv --json");
    addThreads(*sub, common);
    sub->add_option("LOG", request->log, "MRCLAM folder, Husky windows, CSV file or folder of CSV files")->required();
    sub->add_option("--robots", request->robots, "Only these robots, by name: 1,2")->delimiter(',');
    return {sub, [request, &common] { return runInspect(*request, common); }};
}

}  // namespace mrose::cli
