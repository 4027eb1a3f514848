#include "workflow/evaluate_sensor.h"

#include <algorithm>

#include "identification/sensor_samples.h"
#include "identification/sensor_summary.h"
#include "io/format.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/open_sensors.h"

namespace mrose {
namespace {

/// As the referee of the MRCLAM logs asks, but as far as the sensor sees.
CaseRule ruleFor(const SensorNetwork& network) {
    CaseRule rule;
    if (!network.landmarks) rule.subjects = SubjectKind::robot;
    rule.range = std::max(rule.range, network.view.range);
    rule.bearing = std::max(rule.bearing, 0.5 * network.view.fieldOfView);
    return rule;
}

std::vector<std::string> judgedRobots(const LoggedCases& cases) {
    std::vector<std::string> names;
    for (const LoggedCases::Robot& robot : cases.robots) names.push_back(robot.name);
    return names;
}

/// What must be known of the readings before a sensor is blamed for them, a sentence each.
std::vector<std::string> noticesOf(const LoggedCases& cases, const Log& log) {
    std::vector<std::string> notices;
    for (const LoggedCases::Robot& robot : cases.robots) {
        if (20 * robot.gross > robot.readings)
            notices.push_back("Robot " + robot.name + ": " + std::to_string(robot.gross) + " of " +
                              counted(robot.readings, "reading") +
                              " are more than 1 m or 0.15 rad off the truth, and their errors are left out.");
        const auto truths = summariseSensor({&log, 1}, cases.sensor, {robot.name}).falseTruth;
        const auto looks = std::ranges::count_if(cases.looks, [&](const LoggedLook& look) {
            return cases.robots[look.robot].name == robot.name &&
                   std::ranges::any_of(truths, [&](const FalseTruth& off) {
                       return off.trajectory == look.trajectory && look.time >= off.begin && look.time <= off.end;
                   });
        });
        if (looks > 0)
            notices.push_back(
                "Robot " + robot.name + ": at " + std::to_string(looks) + " of " + counted(robot.looks, "look") +
                " its tracked heading was off, see mrose inspect: bearings are judged worse than they are.");
    }
    return notices;
}

}  // namespace

Expected<SensorNetworkEvaluation> evaluateSensor(const EvaluateSensorRequest& request, const Progress& learns,
                                                 const Progress& progress) {
    const auto own = openSensor(request.network, SensorNetwork::Measures::subjects);
    if (!own) return tl::unexpected(own.error());
    const auto log = openLog(request.log, {});
    if (!log) return tl::unexpected(log.error());
    auto cases = loggedCases(*log, own->sensor, request.robots, ruleFor(*own));
    if (!cases) return tl::unexpected(cases.error());
    auto networks = openSensors(*own, request, learns);
    if (!networks) return tl::unexpected(networks.error());
    ReportContext context = sensorContext(*own, request);
    context.notices = noticesOf(*log);
    for (std::string& notice : noticesOf(*own, *log, judgedRobots(*cases)))
        context.notices.push_back(std::move(notice));
    for (std::string& notice : besideNotices(*networks, request, *log)) context.notices.push_back(std::move(notice));
    for (std::string& notice : noticesOf(*cases, *log)) context.notices.push_back(std::move(notice));
    std::vector<std::unique_ptr<SensorModel>> models;
    std::vector<NamedSensor> named;
    const auto add = [&](std::string name, std::unique_ptr<SensorModel> model) {
        named.push_back({std::move(name), model.get()});
        models.push_back(std::move(model));
    };
    for (NamedSensorNetwork& network : *networks)
        add(network.name, std::make_unique<LearnedSensorModel>(std::move(network.network)));
    add("ideal plus noise", std::make_unique<IdealSensorModel>(*own, IdealSensorModel::Noise::constant));
    add("ideal", std::make_unique<IdealSensorModel>(*own, IdealSensorModel::Noise::none));
    auto evaluation = evaluateSensors(*log, std::move(*cases), named, progress);
    if (!evaluation) return tl::unexpected(evaluation.error());
    return SensorNetworkEvaluation{std::move(*evaluation), std::move(context)};
}

}  // namespace mrose
