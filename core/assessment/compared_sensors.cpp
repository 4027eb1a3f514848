#include "assessment/compared_sensors.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "control/observation.h"
#include "geometry/pose.h"
#include "logs/log_lookup.h"
#include "scene/perception.h"
#include "sensing/sensor.h"

namespace mrose {
namespace {

/// Of those that a robot's type has of its own.
std::shared_ptr<const Sensor> sensorNamed(const RobotType& type, const SensorPair& pair) {
    for (const auto& sensor : type.sensors)
        if (sensor->name() == pair.name && (gives(*sensor, pair.landmarks()) || gives(*sensor, pair.robots())))
            return sensor;
    return nullptr;
}

void widen(SensorField& field, const SensorField& more, bool first) {
    if (first) {
        field = more;
        return;
    }
    field.range = field.range == 0 || more.range == 0 ? 0 : std::max(field.range, more.range);
    const double aside = std::abs(wrapAngle(more.direction - field.direction));
    field.fieldOfView = std::min(std::max(field.fieldOfView, more.fieldOfView + 2 * aside), 2 * std::numbers::pi);
}

}  // namespace

bool gives(const Sensor& sensor, const ReadingName& reading) {
    return std::ranges::any_of(sensor.gives(), [&](const ReadingKind& kind) {
        return kind.name == reading && *kind.type == recordType<SeenBody>();
    });
}

SensorField fieldOf(const Sensor& sensor) {
    const BodySight* const sight = sensor.sight();
    return sight == nullptr ? SensorField{} : SensorField{sight->range, sight->fieldOfView, sight->direction};
}

std::vector<SensorPair> sensorPairs(const LogWorld& world) {
    std::set<std::string> names;
    const Scene& scene = world.parts().scene;
    for (const ComparedRobot& robot : world.robots())
        for (const auto& sensor : scene.typeOf(robot.body).sensors) names.insert(sensor->name());
    std::vector<SensorPair> pairs;
    for (const std::string& name : names) {
        SensorPair pair{name, {}, {}};
        bool any = false;
        for (const ComparedRobot& robot : world.robots()) {
            const auto sensor =
                hasLooks(world.log().robots[robot.real], name) ? sensorNamed(scene.typeOf(robot.body), pair) : nullptr;
            pair.sensors.push_back(sensor);
            if (sensor) widen(pair.field, fieldOf(*sensor), !any);
            any = any || sensor;
        }
        if (any) pairs.push_back(std::move(pair));
    }
    return pairs;
}

WorldSubjects::WorldSubjects(const LogWorld& world, const LogWorld::Opened& opened) {
    const std::vector<LogSubject>& subjects = world.log().subjects;
    const std::vector<Landmark> known = landmarksOf(opened.scenario->scene().environment);
    landmarks.resize(subjects.size());
    robots.resize(subjects.size());
    ofLandmark.resize(known.size());
    ofSceneRobot.resize(opened.scenario->scene().robots.size());
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        const LogSubject& subject = subjects[i];
        for (std::size_t k = 0; k < known.size() && subject.kind == LogSubject::Kind::landmark; ++k)
            if (known[k].name == subject.name && subject.position) {
                landmarks[i] = known[k].position;
                ofLandmark[k] = i;
            }
        for (std::size_t k = 0; k < world.robots().size() && subject.kind == LogSubject::Kind::robot; ++k)
            if (opened.starts[k] && world.robots()[k].realName == subject.robot) {
                robots[i] = k;
                ofSceneRobot[opened.bodies[k]] = i;
            }
    }
}

}  // namespace mrose
