#include "quantities/part.h"

#include <algorithm>

namespace mrose {
namespace {

/// What the number of a reading's records is called among the entries of its sensor.
std::string countName(std::string_view reading, const std::string& sensor) {
    if (reading == sensor) return "records";
    return std::string(reading.starts_with(sensor + '.') ? reading.substr(sensor.size() + 1) : reading);
}

void addReading(const NewestReading& known, MemoryEntries& entries) {
    const Reading& reading = *known.reading;
    const std::string_view name = reading.name;
    const std::string sensor = known.sensor->name();
    if (name == sensor) {
        const std::vector<MemoryEntry> summary = known.sensor->summary(*known.of, reading);
        for (const MemoryEntry& entry : summary) entries.add(entry);
        if (!summary.empty()) return;
    }
    if (name != sensor || reading.count != 1) {
        entries.add(countName(name, sensor), static_cast<double>(reading.count));
        return;
    }
    for (const RecordField& field : reading.type->fields)
        if (field.count == 1) entries.add(field.name, field.numberIn(known.of->recordsOf(reading)), field.unit);
}

void addSensorEntries(const Moment& moment, std::size_t robot, std::size_t place, MemoryEntries& entries) {
    const Scenario& scenario = *moment.scenario;
    const Sensor& sensor = *scenario.sensors(robot)[place];
    sensor.explain(scenario.sensorMemory(*moment.state, robot, place), entries);
    for (const NewestReading& known : newestReadings(moment, robot))
        if (known.sensor == &sensor) addReading(known, entries);
}

}  // namespace

std::vector<std::string> partNames(const Scenario& scenario, std::size_t body) {
    const Scene& scene = scenario.scene();
    if (body >= scene.robots.size()) {
        const ObjectModel& model = *scene.typeOfObject(body - scene.robots.size()).motion;
        return model.memorySize() > 0 ? std::vector<std::string>{"motion"} : std::vector<std::string>();
    }
    std::vector<std::string> names{"controller", "motion"};
    for (const SensorPointer& sensor : scenario.sensors(body)) names.push_back(sensor->name());
    return names;
}

std::optional<std::size_t> partNamed(const Scenario& scenario, std::size_t body, std::string_view name) {
    const std::vector<std::string> names = partNames(scenario, body);
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
}

bool isPartNamed(const Scenario& scenario, std::size_t body, std::size_t part, std::string_view name) {
    const bool robot = body < scenario.scene().robots.size();
    if (!robot || part < firstSensorPart) return partNamed(scenario, body, name) == part;
    const auto sensors = scenario.sensors(body);
    return part - firstSensorPart < sensors.size() && sensors[part - firstSensorPart]->name() == name;
}

void addPartEntries(const Moment& moment, std::size_t body, std::size_t part, MemoryEntries& entries) {
    const Scenario& scenario = *moment.scenario;
    const Scene& scene = scenario.scene();
    const std::span<const std::byte> motion = scenario.motionMemory(*moment.state, body);
    if (body >= scene.robots.size())
        scene.typeOfObject(body - scene.robots.size()).motion->explain(motion, entries);
    else if (part == 0)
        scenario.controller(body).explain(scenario.memoryOf(*moment.state, body), entries);
    else if (part == 1)
        scene.modelOf(body).explain(motion, entries);
    else
        addSensorEntries(moment, body, part - firstSensorPart, entries);
}

std::vector<MemoryEntry> partEntries(const Moment& moment, std::size_t body, std::size_t part) {
    MemoryEntries entries;
    addPartEntries(moment, body, part, entries);
    return std::move(entries).all();
}

std::vector<MemoryEntry> knownEntries(const Moment& moment, std::size_t body, std::size_t part) {
    if (body >= moment.scene().robots.size() || part < firstSensorPart) return {};
    const Sensor& sensor = *moment.scenario->sensors(body)[part - firstSensorPart];
    std::vector<MemoryEntry> known =
        explained(sensor, moment.scenario->sensorMemory(*moment.state, body, part - firstSensorPart));
    const std::vector<MemoryEntry> summary = sensor.summary({}, {});
    known.insert(known.end(), summary.begin(), summary.end());
    for (const ReadingKind& kind : sensor.gives()) {
        const bool own = kind.name == ReadingName(sensor.name());
        if (own && !summary.empty()) continue;
        if (own)
            for (const RecordField& field : kind.type->fields)
                if (field.count == 1) known.push_back({field.name, 0, field.unit});
        known.push_back({countName(kind.name, sensor.name())});
    }
    return known;
}

}  // namespace mrose
