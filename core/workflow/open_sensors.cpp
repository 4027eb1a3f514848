#include "workflow/open_sensors.h"

#include <filesystem>

#include "io/file.h"
#include "io/format.h"
#include "learning/network_file.h"
#include "workflow/notices.h"
#include "workflow/sensor_families.h"

namespace mrose {
namespace {

std::string nameOfFile(const std::string& path) { return std::filesystem::path(path).filename().string(); }

std::string noiseText(const SensorNetwork& network) {
    const ConstantNoise& noise = network.constant;
    if (network.measures == SensorNetwork::Measures::pose)
        return "reported at " + fixed(100 * noise.seen, 1) + " % of the instants, ahead ± " +
               fixed(100 * noise.spread[0], 1) + " cm, left ± " + fixed(100 * noise.spread[1], 1) + " cm, heading ± " +
               fixed(1000 * noise.spread[2], 1) + " mrad";
    return fixed(100 * noise.seen, 1) + " % of what is in view and not hidden, " + fixed(100 * noise.unseen, 1) +
           " % of the rest, range ± " + fixed(100 * noise.spread[0], 1) + " cm, bearing ± " +
           fixed(1000 * noise.spread[1], 1) + " mrad";
}

}  // namespace

Expected<bool> isSensorFile(const std::string& path) {
    return readFile(path).map([](const std::string& text) { return networkKind(text) == SensorNetwork::kind; });
}

bool isLocaliserFile(const std::string& path) {
    const auto network = loadSensor(path);
    return network && network->measures == SensorNetwork::Measures::pose;
}

Expected<SensorNetwork> openSensor(const std::string& path, SensorNetwork::Measures measures) {
    auto network = loadSensor(path);
    if (!network || network->measures == measures) return network;
    const bool pose = network->measures == SensorNetwork::Measures::pose;
    return fail(path, pose ? "reports its robot's own pose; expected a sensor of landmarks or robots"
                           : "reports landmarks or robots; expected a sensor of its robot's own pose");
}

Expected<std::vector<NamedSensorNetwork>> openSensors(const SensorNetwork& first, const EvaluateSensorRequest& request,
                                                      const Progress& learns) {
    std::vector<NamedSensorNetwork> networks{{nameOfFile(request.network), first}};
    for (const std::string& path : request.against) {
        auto other = openSensor(path, first.measures);
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

std::vector<std::string> besideNotices(const std::vector<NamedSensorNetwork>& networks,
                                       const EvaluateSensorRequest& request, const Log& log) {
    std::vector<std::string> notices;
    for (std::size_t i = 1; i <= request.against.size(); ++i)
        notices.push_back(besideNotice(networks[i].name, networks[i].network.learned.training, log));
    std::erase(notices, std::string());
    return notices;
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
    if (network.measures == SensorNetwork::Measures::subjects)
        fact("field of view", fixed(degrees * network.view.fieldOfView, 1) + "°, " +
                                  (network.view.nearest > 0 ? fixed(network.view.nearest, 2) + " to " : "") +
                                  fixed(network.view.range, 2) + " m");
    fact("latency", fixed(1000 * toSeconds(network.latency), 0) + " ms");
    fact("gross errors", fixed(100 * network.gross.share, 3) + " % of the readings");
    fact("ideal plus noise", noiseText(network));
    fact("learned by", training.method + ", seed " + std::to_string(training.seed) + ", " +
                           std::to_string(training.patterns) + " cases, " + std::to_string(training.epochs) +
                           " epochs");
    fact("command", training.command);
    fact("held out in learning", "mean log-likelihood of detection " + fixedWithMinus(network.heldOut.reported, 4) +
                                     ", of errors " + fixedWithMinus(network.heldOut.error, 4) +
                                     " (each member on its own part)");
    return context;
}

}  // namespace mrose
