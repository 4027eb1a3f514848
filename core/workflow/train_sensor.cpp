#include "workflow/train_sensor.h"

#include <algorithm>

#include "workflow/learning_logs.h"
#include "workflow/log_files.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"

namespace mrose {
namespace {

/// Within which bearing and range nearly all is reported: edges blur beyond.
View viewOf(const std::vector<Log>& logs, const SensorSampleOptions& options) {
    SensorSampleOptions wide = options;
    wide.view = {1e3, 6.2};
    const SensorSamples samples = sensorSamples(logs, wide);
    std::vector<double> ranges, bearings;
    for (const SensorCase& one : samples.cases)
        if (one.reported) {
            ranges.push_back(one.state.range);
            bearings.push_back(std::abs(one.state.bearing));
        }
    const auto nearlyAll = [](std::vector<double>& values, double share) {
        if (values.empty()) return 1.0;
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
        std::nth_element(values.begin(), at, values.end());
        return *at;
    };
    return {nearlyAll(ranges, 0.999), 2 * nearlyAll(bearings, 0.995)};
}

}  // namespace

Expected<SensorNetwork> trainSensor(const TrainSensorRequest& request, const Progress& progress) {
    std::vector<std::string> read;
    for (const std::string& log : request.logs) read.push_back(placeOfLog(log));
    if (!request.output.empty())
        if (auto can = checkOutput(request.output, read, request.overwrite); !can) return tl::unexpected(can.error());
    std::vector<Log> logs;
    for (const std::string& source : request.logs) {
        auto log = openLog(source, {});
        if (!log) return tl::unexpected(log.error());
        logs.push_back(std::move(*log));
    }
    const auto traits = traitsOf(request.robotKind, logs.front());
    if (!traits) return tl::unexpected(traits.error());
    SensorSampleOptions sampling{.sensor = request.sensor, .robots = request.robots};
    sampling.latency = fromSeconds(request.latency.value_or(0.040));
    sampling.view = viewOf(logs, sampling);
    const SensorSamples samples = sensorSamples(logs, sampling);
    SensorNetwork blueprint;
    blueprint.sensor = request.sensor;
    blueprint.robotType = traits->type;
    blueprint.period = 236'000'000;
    blueprint.latency = sampling.latency;
    blueprint.view = sampling.view;
    blueprint.robotSubjects = true;
    blueprint.learned.training.command = request.command;
    for (const Log& log : logs) {
        blueprint.learned.synthetic |= log.synthetic;
        for (const auto* files : {&log.files, &log.measurementFiles})
            for (const LogFile& file : *files) blueprint.learned.training.logs.push_back({file.path, file.hash});
    }
    auto trained = trainSensor(blueprint, samples, request.training, progress);
    if (!trained || request.output.empty()) return trained;
    if (auto saved = saveSensor(*trained, request.output); !saved) return tl::unexpected(saved.error());
    return trained;
}

}  // namespace mrose
