// Whatever the bytes are, each reader returns a log whose samples are finite and in strictly ascending time, or an
// error of one line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz/require.h"
#include "logs/conditioning.h"
#include "logs/csv_reader.h"
#include "logs/husky_reader.h"
#include "logs/mrclam_reader.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

template <class Sample>
void requireAscending(const std::vector<Sample>& samples) {
    for (std::size_t i = 1; i < samples.size(); ++i) require(samples[i - 1].time < samples[i].time);
}

void requireSound(const SensorLog& sensor, std::size_t subjects) {
    requireAscending(sensor.looks);
    requireAscending(sensor.poses);
    requireAscending(sensor.scans);
    for (const Look& look : sensor.looks)
        for (const LogReading& reading : look.readings)
            require(reading.subject < subjects && std::isfinite(reading.range) && std::isfinite(reading.bearing));
    for (const StampedPose& sample : sensor.poses)
        require(std::isfinite(sample.pose.x) && std::isfinite(sample.pose.heading));
    for (const LogScan& scan : sensor.scans) {
        require(std::isfinite(scan.start) && std::isfinite(scan.step));
        for (const double range : scan.ranges) require(range >= 0);
    }
}

void requireSound(const Trajectory& trajectory) {
    requireAscending(trajectory.commands);
    requireAscending(trajectory.poses);
    requireAscending(trajectory.kicks);
    requireAscending(trajectory.ball);
    for (const StampedKick& kick : trajectory.kicks) require(kick.power >= 0 && kick.power <= 1);
    for (const StampedBall& ball : trajectory.ball) require(isFinite(ball.place));
    requireAscending(trajectory.measuredVelocity);
    requireAscending(trajectory.measuredRotation);
    for (const StampedCommand& sample : trajectory.commands)
        require(std::isfinite(sample.command.v) && std::isfinite(sample.command.w));
    for (const StampedPose& sample : trajectory.poses)
        require(std::isfinite(sample.pose.x) && std::isfinite(sample.pose.y));
    if (!trajectory.poses.empty()) measuredStart(trajectory, trajectory.poses.back().time);
}

void requireSound(const Expected<Log>& log) {
    if (!log) return requireOneLine(log.error());
    for (const RobotLog& robot : log->robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            requireSound(trajectory);
            for (const SensorLog& sensor : trajectory.sensors) requireSound(sensor, log->subjects.size());
        }
}

/// One stream of rows, conditioned.
template <class Rows, class Condition>
void requireConditioned(Rows rows, LogDefects& defects, Condition condition) {
    if (!rows) return requireOneLine(rows.error());
    condition(*rows, LogOptions{}, defects);
    requireAscending(*rows);
}

}  // namespace
}  // namespace mrose

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mrose;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    LogDefects found;
    const auto conditioned = [](auto& rows, const LogOptions& options, auto& defects) {
        conditionCommands(rows, options, defects);
    };
    requireConditioned(parseMrclamOdometry(text, "odometry", found), found, conditioned);
    requireConditioned(parseMrclamGroundtruth(text, "truth", found), found, conditionPoses);
    requireSound(parseHusky(text, "husky"));
    requireSound(parseCsv(text, "csv"));
    return 0;
}
