#include "workflow/predict_readings.h"

#include <algorithm>

#include "assessment/sensor_queries.h"
#include "io/file.h"
#include "workflow/log_files.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"

namespace mrose {

Expected<PredictedReadings> predictReadings(const PredictReadingsRequest& request) {
    if (auto can =
            checkOutput(request.output, {request.network, placeOfLog(request.log), request.queries}, request.overwrite);
        !can)
        return tl::unexpected(can.error());
    auto network = loadSensor(request.network);
    if (!network) return tl::unexpected(network.error());
    const SensorNetwork::Measures measures = network->measures;
    const auto log = openLog(request.log, {});
    if (!log) return tl::unexpected(log.error());
    auto queries = readQueries(request.queries, measures);
    if (!queries) return tl::unexpected(queries.error());
    for (const std::string& robot : request.robots)
        if (std::ranges::find(log->robots, robot, &RobotLog::robot) == log->robots.end())
            return fail(log->source, "has no robot \"" + robot + '"');
    if (!request.robots.empty())
        std::erase_if(*queries, [&](const SensorQuery& query) {
            return std::ranges::find(request.robots, query.robot) == request.robots.end();
        });
    if (queries->empty())
        return fail(request.queries,
                    request.robots.empty() ? "asks nothing" : "asks nothing of the robots of --robots");
    const LearnedSensor sensor(std::move(*network));
    const auto predictions = predictQueries(sensor, LoggedView(*log), *queries, request.queries);
    if (!predictions) return tl::unexpected(predictions.error());
    if (auto written = writeFileAtomically(
            request.output, sensorSamplesCsv(measures, *queries, *predictions, request.samples, request.seed));
        !written)
        return tl::unexpected(written.error());
    return PredictedReadings{queries->size(), log->incomplete};
}

}  // namespace mrose
