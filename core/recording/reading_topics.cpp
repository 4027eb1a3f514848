#include "recording/reading_topics.h"

#include <cmath>
#include <limits>
#include <map>

#include "control/sensor_records.h"
#include "io/base64.h"
#include "recording/json_text.h"
#include "recording/message_schemas.h"

namespace mrose {
namespace {

constexpr Nanoseconds readingPeriod = nanosecondsPerSecond / 10;
constexpr std::size_t oneLine = std::numeric_limits<std::size_t>::max();
constexpr double sensorHeight = 0.2;  // m, for the eye

/// A laser's beams are rays, a sonar has a cone.
bool isLaser(const Sensor& sensor) {
    const std::vector<SensorElement> elements = sensor.elements();
    return !elements.empty() && elements.front().halfWidth == 0;
}

void appendHead(std::string& json, Nanoseconds time, const std::string& frame, const Point& origin) {
    json += "{\"timestamp\":";
    appendTime(json, time);
    json += ",\"frame_id\":";
    appendQuoted(json, frame);
    json += R"(,"pose":{"position":{"x":)";
    appendFixed(json, origin.x, 3);
    json += ",\"y\":";
    appendFixed(json, origin.y, 3);
    json += ",\"z\":";
    appendFixed(json, sensorHeight, 3);
    json += R"(},"orientation":{"x":0,"y":0,"z":0,"w":1}})";
}

/// Ranges in mm; 0 without an echo, since JSON has no infinity.
std::string laserScanMessage(const Observation& of, const Reading& reading, const Sensor& sensor,
                             const std::string& frame) {
    const std::vector<SensorElement> elements = sensor.elements();
    std::string json;
    appendHead(json, reading.measured, frame, position(elements.front().mount));
    json += ",\"start_angle\":";
    appendFixed(json, elements.front().mount.heading, 6);
    json += ",\"end_angle\":";
    appendFixed(json, elements.back().mount.heading, 6);
    json += ",\"ranges\":[";
    const char* between = "";
    for (const RangeEcho& echo : of.records<RangeEcho>(&reading)) {
        json += between;
        appendFixed(json, std::isfinite(echo.range) ? echo.range : 0, 3);
        between = ",";
    }
    return json + "],\"intensities\":[]}";
}

/// Points of x, y, z and a last number, in the robot's frame.
std::string pointCloudMessage(const Observation& of, const Reading& reading, const Sensor& sensor,
                              const std::string& frame) {
    const std::vector<SensorElement> elements = sensor.elements();
    std::vector<float> points;
    const auto add = [&](const Point& at, double last) {
        for (const double number : {at.x, at.y, 0.0, last}) points.push_back(static_cast<float>(number));
    };
    const auto ranges = of.records<RangeEcho>(&reading);
    for (std::size_t i = 0; i < ranges.size() && i < elements.size(); ++i) {
        const Pose& mount = elements[i].mount;
        if (std::isfinite(ranges[i].range))
            add(position(mount) + ranges[i].range * towards(mount.heading), ranges[i].range);
    }
    const auto intensities = of.records<InfraredEcho>(&reading);
    for (std::size_t i = 0; i < intensities.size() && i < elements.size(); ++i)
        add(position(elements[i].mount), intensities[i].intensity);
    std::string json;
    appendHead(json, reading.measured, frame, {});
    json += R"(,"point_stride":16,"fields":[)";
    const char* const last = ranges.empty() ? "intensity" : "range";
    int offset = 0;
    for (const char* const name : {"x", "y", "z", last}) {
        json += (offset == 0 ? "" : ",") + std::string("{\"name\":\"") + name +
                "\",\"offset\":" + std::to_string(offset) + ",\"type\":7}";
        offset += 4;
    }
    const auto* const bytes = reinterpret_cast<const char*>(points.data());
    return json + "],\"data\":\"" + base64({bytes, points.size() * sizeof(float)}, oneLine) + "\"}";
}

std::string readingMessage(const Observation& of, const Reading& reading) {
    std::string json = "{\"timestamp\":";
    appendTime(json, reading.measured);
    json += ",\"records\":[";
    const std::byte* record = of.recordsOf(reading);
    for (std::uint32_t k = 0; k < reading.count; ++k, record += reading.type->size) {
        json += k == 0 ? "{" : ",{";
        const char* between = "";
        for (const RecordField& field : reading.type->fields) {
            json += between;
            appendQuoted(json, field.name);
            json += field.count == 1 ? ":" : ":[";
            for (std::uint32_t i = 0; i < field.count; ++i) {
                if (i > 0) json += ',';
                const bool whole = field.kind != NumberKind::float64 && field.kind != NumberKind::float32;
                appendFixed(json, field.numberIn(record, i), whole ? 0 : 4);
            }
            if (field.count > 1) json += ']';
            between = ",";
        }
        json += '}';
    }
    return json + "]}";
}

std::string messageOf(const Observation& of, const Reading& reading, const Sensor& sensor, const std::string& frame) {
    if (*reading.type == recordType<RangeEcho>() && isLaser(sensor))
        return laserScanMessage(of, reading, sensor, frame);
    if (*reading.type == recordType<RangeEcho>() || *reading.type == recordType<InfraredEcho>())
        return pointCloudMessage(of, reading, sensor, frame);
    return readingMessage(of, reading);
}

}  // namespace

ReadingTopics::Schemas ReadingTopics::addSchemas(mcap::Writer& writer) {
    return {writer.addSchema("foxglove.LaserScan", "jsonschema", laserScanSchema()),
            writer.addSchema("foxglove.PointCloud", "jsonschema", pointCloudSchema())};
}

ReadingTopics::ReadingTopics(mcap::Writer& writer, const Schemas& schemas, const Scenario& scenario,
                             std::span<const std::string> frames) {
    std::map<std::string, std::uint16_t> others;
    const auto schemaOf = [&](const Sensor& sensor, const RecordType& type) {
        if (type == recordType<RangeEcho>() && isLaser(sensor)) return schemas.laserScan;
        if (type == recordType<RangeEcho>() || type == recordType<InfraredEcho>()) return schemas.pointCloud;
        const auto [known, isNew] = others.try_emplace(type.name);
        if (isNew) known->second = writer.addSchema(readingTitle(type), "jsonschema", readingSchema(type));
        return known->second;
    };
    for (std::size_t robot = 0; robot < scenario.scene().robots.size(); ++robot)
        for (const SensorPointer& sensor : scenario.scene().typeOf(robot).sensors)
            for (const ReadingKind& kind : sensor->gives()) {
                if (topics_.size() == most) return;
                const std::string topic = '/' + frames[robot] + '/' + std::string(std::string_view(kind.name));
                topics_.push_back({robot, kind.name, sensor.get(), frames[robot],
                                   writer.addChannel(schemaOf(*sensor, *kind.type), topic, "json")});
            }
}

void ReadingTopics::add(mcap::Writer& writer, const StepTrace& trace, Nanoseconds time) {
    const Nanoseconds sample = time / readingPeriod;
    for (Topic& topic : topics_) {
        if (topic.sample == sample) continue;
        const StepTrace::Robot& robot = trace.robots[topic.robot];
        const Observation* of = &robot.unread;
        const Reading* reading = of->newest(topic.reading);
        if (reading == nullptr && robot.observed) {
            of = &robot.observation;
            reading = of->newest(topic.reading);
        }
        if (reading == nullptr) continue;
        topic.sample = sample;
        writer.addMessage(topic.channel, time, messageOf(*of, *reading, *topic.sensor, topic.frame));
    }
}

}  // namespace mrose
