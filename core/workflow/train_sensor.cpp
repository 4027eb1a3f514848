#include "workflow/train_sensor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "identification/nearest_seen.h"
#include "identification/sensor_summary.h"
#include "io/format.h"
#include "logs/log_lookup.h"
#include "logs/sensor_defects.h"
#include "logs/unit_doubts.h"
#include "workflow/learning_logs.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"

namespace mrose {
namespace {

/// What this share of the values does not exceed.
double quantileOf(std::vector<double> values, double share) {
    if (values.empty()) return 1;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Fills in what subjects are reported, and within which bearing and range nearly all are: edges blur beyond.
void lookAround(SensorNetwork& blueprint, SensorSampleOptions& sampling, const std::vector<Log>& logs) {
    if (blueprint.measures == SensorNetwork::Measures::pose) return;
    SensorSampleOptions wide = sampling;
    wide.view = {1e3, 6.2};
    blueprint.landmarks = blueprint.robotSubjects = false;
    std::vector<double> ranges, bearings;
    const SensorSamples samples = sensorSamples(logs, wide);
    for (const SensorCase& one : samples.cases) {
        if (!one.reported) continue;
        ranges.push_back(one.state.range);
        bearings.push_back(std::abs(one.state.bearing));
        (one.state.subject == SubjectKind::robot ? blueprint.robotSubjects : blueprint.landmarks) = true;
    }
    blueprint.view.range = quantileOf(std::move(ranges), 0.999);
    blueprint.view.fieldOfView = 2 * quantileOf(std::move(bearings), 0.995);
    blueprint.view.nearest = nearestSeen(samples, blueprint.view);
    sampling.view = blueprint.view;
    sampling.landmarks = blueprint.landmarks;
    sampling.robotSubjects = blueprint.robotSubjects;
}

Expected<void> checkHolds(const Log& log, const std::string& sensor) {
    const std::vector<std::string> names = sensorNames(log);
    if (std::ranges::find(names, sensor) != names.end()) return {};
    if (names.empty())
        return fail(log.source, log.withIncomplete("holds no measurements, of which a sensor could be learned"));
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    return fail(log.source, log.withIncomplete("has no sensor \"" + sensor + "\"; it has " + all));
}

bool holdsRobot(const Log& log, const std::string& robot) {
    return std::ranges::find(log.robots, robot, &RobotLog::robot) != log.robots.end();
}

Expected<std::vector<Log>> openAll(const TrainSensorRequest& request) {
    std::vector<Log> logs;
    for (const std::string& source : request.logs) {
        auto log = openLog(source, {});
        if (!log) return tl::unexpected(log.error());
        if (auto holds = checkHolds(*log, request.sensor); !holds) return tl::unexpected(holds.error());
        if (auto fits = checkMetres(*log); !fits) return tl::unexpected(fits.error());
        logs.push_back(std::move(*log));
    }
    for (const std::string& robot : request.robots)
        if (std::ranges::none_of(logs, [&](const Log& log) { return holdsRobot(log, robot); }))
            return fail(logs.front().source, "has no robot \"" + robot + '"');
    return logs;
}

// What a network file may state, s.
constexpr double longestLatency = 1, longestPeriod = 10;

/// Sets the latency that was found; what cannot be stated, or was not found, is a notice.
void setLatency(SensorNetwork& blueprint, const SensorLateness& found, std::vector<std::string>& notices) {
    if (!found.identified) {
        notices.push_back("Its latency is not known, and taken as 0: " + found.reason + ".");
        return;
    }
    const double latency = std::clamp(found.lateness, 0.0, longestLatency);
    blueprint.latency = fromSeconds(latency);
    blueprint.latencyError = found.error;
    if (std::abs(latency - found.lateness) <= 2 * found.error) return;
    char text[100];
    std::snprintf(text, sizeof text, "Its latency of %.0f ms is taken as %.0f ms, the nearest that a sensor can have.",
                  1e3 * found.lateness, 1e3 * latency);
    notices.emplace_back(text);
}

/// What is to be learned, but for what the samples say. What was not found is a notice.
SensorNetwork blueprintOf(const TrainSensorRequest& request, const SensorSummary& found, const std::vector<Log>& logs,
                          std::vector<std::string>& notices) {
    SensorNetwork blueprint;
    blueprint.sensor = request.sensor;
    blueprint.measures = found.readings > 0 ? SensorNetwork::Measures::subjects : SensorNetwork::Measures::pose;
    if (toSeconds(found.period) <= longestPeriod) blueprint.period = found.period;
    if (request.latency)
        blueprint.latency = fromSeconds(*request.latency);
    else
        setLatency(blueprint, found.lateness, notices);
    for (const Log& log : logs) {
        blueprint.learned.synthetic = blueprint.learned.synthetic || log.synthetic;
        for (const std::vector<LogFile>& files : {log.files, log.measurementFiles})
            for (const LogFile& file : files) blueprint.learned.training.logs.push_back({file.path, file.hash});
    }
    blueprint.learned.training.command = request.command;
    return blueprint;
}

/// Of readings of any robot that are mostly off the ground truth.
Expected<void> checkFits(const SensorSummary& summary, const std::vector<Log>& logs) {
    constexpr std::size_t fewest = 20;  // readings: fewer say nothing, and are of no weight
    const auto misfit = [](const Log& log, const std::string& cause) {
        return fail(log.source, withUnitDoubts(cause, log));
    };
    for (const auto& [log, robot, found] : summary.each) {
        const Log& of = logs[log];
        const std::string name = "robot " + of.robots[robot].robot;
        if (found.known >= fewest && 2 * found.gross > found.known)
            return misfit(of, misfitCause(found.sensor, name, static_cast<std::int64_t>(found.gross),
                                          static_cast<std::int64_t>(found.known)));
        if (found.pose.looksExchanged())
            return misfit(of, '"' + found.sensor + "\" of " + name +
                                  " does not fit the ground truth: " + exchangedText(found.pose));
        if (found.followed)
            return misfit(of, "the readings of \"" + found.sensor + "\" of " + name +
                                  " do not fit the ground truth: they show " +
                                  fixed(std::max(0.0, 100 * *found.followed), 0) +
                                  " % of how the robot truly moved; are their stamps of another clock?");
    }
    return {};
}

}  // namespace

Expected<TrainedSensor> trainSensor(const TrainSensorRequest& request, const Progress& progress) {
    std::vector<std::string> read;
    for (const std::string& log : request.logs) read.push_back(placeOfLog(log));
    if (!request.output.empty())
        if (auto can = checkOutput(request.output, read, request.overwrite); !can) return tl::unexpected(can.error());
    const auto logs = openAll(request);
    if (!logs) return tl::unexpected(logs.error());
    const auto traits = traitsOf(request.robotKind, logs->front());
    if (!traits) return tl::unexpected(traits.error());
    const SensorSummary found = summariseSensor(*logs, request.sensor, request.robots);
    if (found.readings + found.poses == 0 && found.scans > 0)
        return fail(logs->front().source, "\"" + request.sensor + "\" reports scans, which cannot be learned");
    if (const auto fits = checkFits(found, *logs); !fits) return tl::unexpected(fits.error());
    std::vector<std::string> notices;
    for (const Log& log : *logs)
        for (std::string& notice : noticesOf(log)) notices.push_back(std::move(notice));
    const std::size_t ofLogs = notices.size();
    SensorNetwork blueprint = blueprintOf(request, found, *logs, notices);
    blueprint.robotType = traits->type;
    SensorSampleOptions sampling{.sensor = request.sensor,
                                 .measures = blueprint.measures,
                                 .robots = request.robots,
                                 .latency = blueprint.latency};
    if (found.clocked) sampling.period = found.period;
    sampling.falseTruth = found.falseTruth;
    lookAround(blueprint, sampling, *logs);
    const SensorSamples samples = sensorSamples(*logs, sampling);
    if (samples.falseTruth > 0)
        notices.push_back("Left out: " + counted(static_cast<std::size_t>(samples.falseTruth), "look") +
                          " at which the ground truth was off, see mrose inspect.");
    auto network = trainSensor(blueprint, samples, request.training, progress);
    if (!network) {
        Error error = network.error();
        if (ofLogs > 0 && error.file.empty()) error.cause += ". " + notices.front();
        return atFile(std::move(error), logs->front().source);
    }
    TrainedSensor trained{std::move(*network), std::move(notices)};
    if (request.output.empty()) return trained;
    if (auto saved = saveSensor(trained.network, request.output); !saved) return tl::unexpected(saved.error());
    return trained;
}

}  // namespace mrose
