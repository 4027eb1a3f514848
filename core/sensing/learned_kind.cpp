#include "sensing/learned_kind.h"

#include "sensing/learned_camera.h"
#include "sensing/learned_localiser.h"
#include "sensing/sensor_keys.h"

namespace mrose {
namespace {

std::string knownRobots(const SensorNetwork& network) {
    std::string known;
    for (const std::string& robot : network.robots) known += (known.empty() ? "\"" : ", \"") + robot + '"';
    return known.empty() ? "none" : known;
}

}  // namespace

SensorPointer readLearnedSensor(TomlTable& table, const SensorTraits& traits, const SensorSources& sources) {
    const std::shared_ptr<const LearnedSensor> learned = sources.network(table, "network");
    LearnedSensorOptions options;
    if (table.has("robot")) options.robot = name(table, "robot");
    if (!learned || table.failed()) return nullptr;
    const SensorNetwork& network = learned->network();
    if (options.robot && learned->robotIndex(*options.robot) < 0)
        table.reject("robot", "is none of the network's robots: " + knownRobots(network));
    if (table.has("latency_s")) options.latency = duration(table, "latency_s", latencies);
    if (network.measures == SensorNetwork::Measures::pose)
        return table.failed() ? nullptr : std::make_shared<const LearnedLocaliser>(learned, traits, options);
    if (traits.name.size() > LearnedCamera::mostName)
        table.reject("name", "expected at most " + std::to_string(LearnedCamera::mostName) +
                                 " characters, because of the reading \"" + traits.name + ".landmarks\"");
    return table.failed() ? nullptr : std::make_shared<const LearnedCamera>(learned, traits, options);
}

}  // namespace mrose
