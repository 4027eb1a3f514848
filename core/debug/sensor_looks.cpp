#include "debug/sensor_looks.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "geometry/elementary.h"
#include "geometry/point.h"
#include "perception/logged_view.h"

namespace mrose {
namespace {

bool isOf(std::string_view reading, std::string_view kind) {
    return reading == kind || (reading.size() > kind.size() && reading.ends_with(kind) &&
                               reading[reading.size() - kind.size() - 1] == '.');
}

/// Who it is, by the reading's name: others than robots, objects and landmarks are known by their numbers alone.
void nameSubject(const FieldFrame& frame, std::string_view reading, std::uint32_t index, Nanoseconds measured,
                 ReportedSubject& subject) {
    const std::span<const Landmark> landmarks = frame.scenario->obstacles().landmarks();
    const std::size_t robots = frame.scene().robots.size();
    const std::size_t body = isOf(reading, objectsReading) ? robots + index : index;
    if (isOf(reading, "landmarks") && index < landmarks.size()) {
        subject.name = "landmark " + landmarks[index].name;
        subject.truth = landmarks[index].position;
    } else if ((isOf(reading, robotsReading) || isOf(reading, objectsReading)) && body < frame.scene().bodyCount()) {
        subject.name = frame.nameOf(body);
        if (const Pose* const pose = frame.poseThen(body, measured)) subject.truth = position(*pose);
    } else {
        subject.name = std::to_string(index + 1);
    }
}

/// The newest at `now` that is no older than a pause and a half of those around; nullptr: there is none.
const Look* lastLook(const std::vector<Look>& looks, Nanoseconds now) {
    constexpr std::ptrdiff_t around = 16;
    const auto after = std::upper_bound(looks.begin(), looks.end(), now,
                                        [](Nanoseconds time, const Look& look) { return time < look.time; });
    if (after == looks.begin()) return nullptr;
    const auto from = looks.begin() + std::max<std::ptrdiff_t>(0, after - looks.begin() - around);
    const auto to =
        looks.begin() + std::min<std::ptrdiff_t>(looks.end() - looks.begin(), after - looks.begin() + around);
    std::vector<Nanoseconds> pauses;
    for (auto look = from; look + 1 < to; ++look) pauses.push_back((look + 1)->time - look->time);
    const Look& last = *std::prev(after);
    if (pauses.empty()) return now == last.time ? &last : nullptr;
    const auto middle = pauses.begin() + static_cast<std::ptrdiff_t>(pauses.size() / 2);
    std::nth_element(pauses.begin(), middle, pauses.end());
    return now - last.time <= *middle * 3 / 2 ? &last : nullptr;
}

/// The real robot that drove what a simulated one repeats; nullptr: none.
const Reality::Robot* drivenAs(const FieldFrame& frame, std::size_t robot) {
    if (!frame.reality || robot >= frame.scene().robots.size()) return nullptr;
    return frame.reality->robotNamed(frame.scene().robots[robot].name);
}

/// As simulated looks call it.
std::string nameOf(const Reality& reality, const LogSubject& subject) {
    if (subject.kind == LogSubject::Kind::landmark) return "landmark " + subject.name;
    for (const Reality::Robot& robot : reality.robots)
        if (robot.realName == subject.robot) return robot.name;
    return "robot " + (subject.robot.empty() ? subject.name : subject.robot);
}

}  // namespace

Point SensorLook::reported(const ReportedSubject& subject) const {
    return position(*eye) + subject.range * towards(eye->heading + subject.bearing);
}

std::vector<SensorLook> simulatedLooks(const FieldFrame& frame, std::size_t robot) {
    std::vector<SensorLook> looks;
    for (const NewestReading& known : newestReadings(frame.moment(), robot)) {
        const Nanoseconds measured = known.reading->measured;
        if (*known.reading->type != recordType<SeenBody>()) continue;
        const std::string name = known.sensor->name();
        const bool same = !looks.empty() && looks.back().sensor == name && looks.back().measured == measured;
        if (!same) {
            const Pose* const eye = frame.poseThen(robot, measured);
            looks.push_back({name, measured, eye ? std::optional(*eye) : std::nullopt, {}});
        }
        for (const SeenBody& body : known.records<SeenBody>()) {
            ReportedSubject& subject = looks.back().subjects.emplace_back();
            subject.range = length(body.position_B);
            subject.bearing = arcTangent(body.position_B.y, body.position_B.x);
            nameSubject(frame, known.reading->name, body.index, measured, subject);
        }
    }
    return looks;
}

std::vector<std::string> realLookers(const FieldFrame& frame, std::size_t robot) {
    std::vector<std::string> names;
    if (const Reality::Robot* const real = drivenAs(frame, robot))
        for (const SensorLog& sensor : real->trajectory->sensors)
            if (!sensor.looks.empty()) names.push_back(sensor.sensor);
    return names;
}

std::vector<SensorLook> realLooks(const FieldFrame& frame, std::size_t robot) {
    std::vector<SensorLook> looks;
    const Reality::Robot* const real = drivenAs(frame, robot);
    if (real == nullptr || !frame.reality->log) return looks;
    const Log& log = *frame.reality->log;
    const LoggedView view(log);
    for (const SensorLog& sensor : real->trajectory->sensors) {
        const Look* const last = lastLook(sensor.looks, real->origin + frame.now());
        if (last == nullptr) continue;
        Nanoseconds late = 0;
        for (const SensorPointer& simulated : frame.scenario->sensors(robot))
            if (simulated->name() == sensor.sensor) late = simulated->latency();
        SensorLook& look = looks.emplace_back();
        look.sensor = sensor.sensor;
        look.measured = last->time - late - real->origin;
        look.eye = real->poseAt(look.measured);
        for (const LogReading& reading : last->readings)
            look.subjects.push_back({nameOf(*frame.reality, log.subjects[reading.subject]), reading.range,
                                     wrapAngle(reading.bearing),
                                     view.positionOf(*real->trajectory, reading.subject, last->time - late)});
    }
    return looks;
}

}  // namespace mrose
