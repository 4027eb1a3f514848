#include "workflow/evaluate_sensor.h"

#include <algorithm>
#include <filesystem>

#include "identification/sensor_samples.h"
#include "identification/sensor_summary.h"
#include "io/file.h"
#include "io/format.h"
#include "learning/network_file.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/sensor_families.h"

namespace mrose {
namespace {

struct NamedNetwork {
    std::string name;
    SensorNetwork network;
};

std::string nameOfFile(const std::string& path) { return std::filesystem::path(path).filename().string(); }

Expected<SensorNetwork> openSensor(const std::string& path) {
    auto network = loadSensor(path);
    if (network && network->measures != SensorNetwork::Measures::subjects)
        return fail(path, "reports its robot's own pose; mrose evaluate judges sensors of landmarks and robots alone");
    return network;
}

/// The networks that are compared, the one that a report is about first.
Expected<std::vector<NamedNetwork>> openSensors(const SensorNetwork& first, const EvaluateSensorRequest& request,
                                                const Progress& learns) {
    std::vector<NamedNetwork> networks{{nameOfFile(request.network), first}};
    for (const std::string& path : request.against) {
        auto other = openSensor(path);
        if (!other) return tl::unexpected(other.error());
        if (other->sensor != first.sensor)
            return fail(path, "is of a sensor called \"" + other->sensor + "\"; " + request.network +
                                  " is of one called \"" + first.sensor + '"');
        networks.push_back({nameOfFile(path), std::move(*other)});
    }
    if (!request.families) return networks;
    auto families = learnOtherFamilies(first, request.network, learns);
    if (!families) return tl::unexpected(families.error());
    for (SensorNetwork& network : *families) {
        std::string name = describedFamily(familyOf(network.learned.regressor));
        networks.push_back({std::move(name), std::move(network)});
    }
    return networks;
}

/// As the referee of the MRCLAM logs asks, but as far as the sensor sees.
CaseRule ruleFor(const SensorNetwork& network) {
    CaseRule rule;
    if (!network.landmarks) rule.subjects = SubjectKind::robot;
    rule.range = std::max(rule.range, network.view.range);
    rule.bearing = std::max(rule.bearing, 0.5 * network.view.fieldOfView);
    return rule;
}

std::string noiseText(const ConstantNoise& noise) {
    return fixed(100 * noise.seen, 1) + " % of what is in view and not hidden, " + fixed(100 * noise.unseen, 1) +
           " % of the rest, range ± " + fixed(100 * noise.spread[0], 1) + " cm, bearing ± " +
           fixed(1000 * noise.spread[1], 1) + " mrad";
}

ReportContext sensorContext(const SensorNetwork& network, const EvaluateSensorRequest& request) {
    const NetworkTraining& training = network.learned.training;
    ReportContext context = contextOf(training, request.command);
    const auto fact = [&](const char* name, std::string value) {
        context.modelFacts.emplace_back(name, std::move(value));
    };
    fact("file", request.network);
    fact("sensor", network.sensor + " of " + network.robotType + (network.learned.synthetic ? " (synthetic)" : ""));
    fact("family", describedFamily(familyOf(network.learned.regressor)) + ", " +
                       std::to_string(network.learned.inputs.size()) + " inputs, " +
                       counted(static_cast<std::size_t>(network.form.components), "normal distribution") +
                       " in its mixture");
    fact("field of view", fixed(degrees * network.view.fieldOfView, 1) + "°, " + fixed(network.view.range, 2) + " m");
    fact("latency", fixed(1000 * toSeconds(network.latency), 0) + " ms");
    fact("gross errors", fixed(100 * network.gross.share, 3) + " % of the readings");
    fact("ideal plus noise", noiseText(network.constant));
    fact("learned by", training.method + ", seed " + std::to_string(training.seed) + ", " +
                           std::to_string(training.patterns) + " cases, " + std::to_string(training.epochs) +
                           " epochs");
    fact("command", training.command);
    fact("held out in learning", "mean log-likelihood of detection " + fixedWithMinus(network.heldOut.reported, 4) +
                                     ", of errors " + fixedWithMinus(network.heldOut.error, 4) +
                                     " (each member on its own part)");
    return context;
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

Expected<bool> isSensorFile(const std::string& path) {
    return readFile(path).map([](const std::string& text) { return networkKind(text) == SensorNetwork::kind; });
}

Expected<SensorNetworkEvaluation> evaluateSensor(const EvaluateSensorRequest& request, const Progress& learns,
                                                 const Progress& progress) {
    const auto own = openSensor(request.network);
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
    for (std::string& notice : noticesOf(*cases, *log)) context.notices.push_back(std::move(notice));
    std::vector<std::unique_ptr<SensorModel>> models;
    std::vector<NamedSensor> named;
    const auto add = [&](std::string name, std::unique_ptr<SensorModel> model) {
        named.push_back({std::move(name), model.get()});
        models.push_back(std::move(model));
    };
    for (NamedNetwork& network : *networks)
        add(network.name, std::make_unique<LearnedSensorModel>(std::move(network.network)));
    add("ideal plus noise", std::make_unique<IdealSensorModel>(*own, IdealSensorModel::Noise::constant));
    add("ideal", std::make_unique<IdealSensorModel>(*own, IdealSensorModel::Noise::none));
    auto evaluation = evaluateSensors(*log, std::move(*cases), named, progress);
    if (!evaluation) return tl::unexpected(evaluation.error());
    return SensorNetworkEvaluation{std::move(*evaluation), std::move(context)};
}

}  // namespace mrose
