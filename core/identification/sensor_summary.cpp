#include "identification/sensor_summary.h"

#include <algorithm>
#include <cmath>

#include "identification/robust_statistics.h"

namespace mrose {
namespace {

/// Time by the periods of a clock that have passed, where few reports are missing between two and none was held up.
class ClockCount {
public:
    explicit ClockCount(double period) : period_(period) {}

    template <class Report>
    void add(const std::vector<Report>& reports) {
        constexpr double most = 8, near = 0.25;  // periods
        for (std::size_t i = 1; i < reports.size(); ++i) {
            const double pause = toSeconds(reports[i].time - reports[i - 1].time);
            const double periods = std::round(pause / period_);
            if (periods < 1 || periods > most || std::abs(pause / period_ - periods) > near) continue;
            seconds_ += pause;
            periods_ += periods;
        }
    }
    double period() const { return periods_ > 0 ? seconds_ / periods_ : period_; }

private:
    double period_, seconds_ = 0, periods_ = 0;
};

bool isOneOf(const RobotLog& robot, const std::vector<std::string>& robots) {
    return robots.empty() || std::ranges::find(robots, robot.robot) != robots.end();
}

/// More exact than the median, which is too long where reports are missing and stamps jitter.
double clockPeriod(std::span<const Log> logs, const std::string& name, const std::vector<std::string>& robots,
                   double median) {
    ClockCount count(median);
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories)
                for (const SensorLog& sensor : trajectory.sensors) {
                    if (sensor.sensor != name || !isOneOf(robot, robots)) continue;
                    count.add(sensor.looks);
                    count.add(sensor.poses);
                }
    return count.period();
}

}  // namespace

SensorSummary summariseSensor(std::span<const Log> logs, const std::string& sensor,
                              const std::vector<std::string>& robots) {
    constexpr double regular = 0.3;  // spread of the time between reports, in periods
    SensorSummary summary;
    std::vector<double> periods, spreads;
    std::vector<SensorLateness> latenesses;
    for (std::size_t log = 0; log < logs.size(); ++log)
        for (std::size_t robot = 0; robot < logs[log].robots.size(); ++robot) {
            const RobotLog& from = logs[log].robots[robot];
            if (!isOneOf(from, robots)) continue;
            const SensorInspection found = inspectSensor(logs[log], from, sensor);
            if (found.looks + found.poses + found.scans == 0) continue;
            for (const SensorChange& change : found.changes)
                if (change.cause == SensorChange::Cause::truth)
                    summary.falseTruth.push_back({log, robot, change.index, change.firstStamp, change.lastStamp});
            summary.readings += found.readings;
            summary.poses += found.poses;
            summary.scans += found.scans;
            summary.each.push_back({log, robot, found});
            latenesses.push_back(found.lateness);
            if (found.period <= 0) continue;
            periods.push_back(found.period);
            spreads.push_back(found.periodSpread / found.period);
        }
    summary.lateness = pooledLateness(latenesses);
    if (periods.empty()) return summary;
    summary.clocked = medianOf(spreads) < regular;
    const double median = medianOf(periods);
    summary.period = fromSeconds(summary.clocked ? clockPeriod(logs, sensor, robots, median) : median);
    return summary;
}

SensorLateness pooledLateness(std::span<const SensorLateness> each) {
    constexpr double leastError = 1e-4;  // s: no robot decides alone
    double count = 0, weights = 0, sum = 0, squares = 0;
    for (const SensorLateness& one : each) {
        if (!one.identified) continue;
        const double error = std::max(one.error, leastError), weight = 1 / (error * error);
        ++count;
        weights += weight;
        sum += weight * one.lateness;
        squares += weight * one.lateness * one.lateness;
    }
    if (weights > 0) {
        const double mean = sum / weights, off = std::max(0.0, squares - weights * mean * mean);
        const double disagreement = count > 1 ? std::max(1.0, off / (count - 1)) : 1;
        return {true, {}, mean, std::sqrt(disagreement / weights)};
    }
    return {false, each.empty() ? "nothing was reported" : each.front().reason};
}

}  // namespace mrose
