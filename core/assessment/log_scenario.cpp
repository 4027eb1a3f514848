#include "assessment/log_scenario.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "assessment/log_world.h"
#include "control/reading.h"
#include "io/format.h"
#include "scenario/description_reader.h"

namespace mrose {
namespace {

constexpr const char* placeName = "open place.toml";

/// What the robots of a log are, and where they drive.
struct Kind {
    std::string robotFile, robotName, environment;
    std::vector<std::string> known;  ///< robots that the kind's network distinguishes
};

std::optional<Kind> kindOf(const Log& log, const RobotKinds& kinds) {
    const RobotKind* const kind = kindOfLog(kinds, log);
    if (kind == nullptr) return {};
    return Kind{kind->file, kind->robotName, kind->environment.empty() ? placeName : kind->environment, kind->robots};
}

/// All that the robots drive in, with room round it, in whole metres.
struct Place {
    double left = 0, right = 0, bottom = 0, top = 0;

    double span() const { return std::max(right - left, top - bottom); }
    double farthest() const { return std::max({-left, right, -bottom, top}); }
};

Place placeOf(const Log& log) {
    Place place;
    bool any = false;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories)
            for (const StampedPose& stamped : trajectory.poses) {
                const double x = stamped.pose.x, y = stamped.pose.y;
                if (!std::exchange(any, true)) place = {x, x, y, y};
                place = {std::min(place.left, x), std::max(place.right, x), std::min(place.bottom, y),
                         std::max(place.top, y)};
            }
    return {std::floor(place.left) - 1, std::ceil(place.right) + 1, std::floor(place.bottom) - 1,
            std::ceil(place.top) + 1};
}

Value openPlace(const Place& place) {
    const auto corner = [](double x, double y) { return Value::Array{x, y}; };
    Value::Table environment{{"format", "mrose environment"}, {"version", 1}, {"name", "open place"}};
    environment.emplace(
        "floor",
        Value::Table{{"area_m", Value::Array{corner(place.left, place.bottom), corner(place.right, place.bottom),
                                             corner(place.right, place.top), corner(place.left, place.top)}}});
    return std::make_shared<const DescriptionFile>(DescriptionFile{placeName, placeName, std::move(environment)});
}

Expected<void> checkPlace(const Log& log) {
    const Place place = placeOf(log);
    if (place.farthest() <= metresFar) return {};
    return fail(log.source, "has ground truth that spans " + fixed(place.span() - 2, 0) + " m, up to " +
                                fixed(place.farthest() - 1, 0) +
                                " m from the origin; positions are expected in metres, within " + fixed(metresFar, 0) +
                                " m");
}

/// "create 3"; a robot that the log calls what it is needs no more.
std::string nameOf(const Kind& kind, const RobotLog& robot) {
    return kind.robotName == robot.robot ? robot.robot : kind.robotName + ' ' + robot.robot;
}

/// The sensors that report subjects in its log, once each.
Value::Array camerasOf(const RobotLog& robot) {
    std::set<std::string> names;
    for (const Trajectory& trajectory : robot.trajectories)
        for (const SensorLog& sensor : trajectory.sensors)
            if (!sensor.looks.empty() && sensor.sensor.size() <= ReadingName::most) names.insert(sensor.sensor);
    return {names.begin(), names.end()};
}

}  // namespace

bool namesRobotKind(const Log& log, const RobotKinds& kinds) { return kindOfLog(kinds, log) != nullptr; }

Expected<void> checkPlayable(const Log& log, const RobotKinds& kinds, const std::vector<std::string>& robots) {
    const bool some = std::any_of(log.robots.begin(), log.robots.end(), hasBothSides);
    for (const RobotLog& robot : log.robots) {
        if (!robots.empty() && std::find(robots.begin(), robots.end(), robot.robot) == robots.end()) continue;
        if (robots.empty() && some && !hasBothSides(robot)) continue;  // the others are compared
        Expected<void> playable;
        for (const Trajectory& trajectory : robot.trajectories) {
            auto comparable = checkComparable(log, robot, trajectory);
            if (comparable || playable) playable = comparable;
            if (comparable) break;
        }
        if (!playable) return playable;
    }
    const auto kind = kindOf(log, kinds);
    return kind && kind->environment != placeName ? Expected<void>() : checkPlace(log);
}

Expected<ScenarioValue> scenarioOfLog(const Log& log, const std::string& place, const RobotKinds& kinds,
                                      const std::string& robotFile) {
    std::optional<Kind> kind = kindOf(log, kinds);
    if (!robotFile.empty())
        kind = Kind{robotFile, "robot", kind ? kind->environment : placeName,
                    kind && kind->robotFile == robotFile ? kind->known : std::vector<std::string>{}};
    if (!kind)
        return fail(log.source,
                    "does not say what kind of robot drove; expected a robot file (--robot), or a scenario whose "
                    "robots play it");
    if (log.robots.empty()) return fail(log.source, "has no robots");
    if (kind->environment == placeName)
        if (auto inside = checkPlace(log); !inside) return tl::unexpected(inside.error());
    const std::string name = std::filesystem::path(log.source).filename().string();
    Value::Array robots;
    for (const RobotLog& robot : log.robots) {
        Value::Table table{{"name", nameOf(*kind, robot)}, {"type", kind->robotFile}};
        if (std::find(kind->known.begin(), kind->known.end(), robot.robot) != kind->known.end())
            table.emplace("motion_robot", robot.robot);
        Value::Table player{{"kind", "log_player"}, {"log", place}, {"robot", robot.robot}};
        if (Value::Array cameras = camerasOf(robot); !cameras.empty()) player.emplace("reads", std::move(cameras));
        table.emplace("controller", std::move(player));
        robots.emplace_back(std::move(table));
    }
    Value::Table scenario{
        {"format", "mrose scenario"}, {"version", 1}, {"name", name}, {"seed", 1}, {"duration_s", 60.0},
        {"robot", std::move(robots)}};
    scenario.emplace("environment",
                     kind->environment == placeName ? openPlace(placeOf(log)) : Value(kind->environment));
    return ScenarioValue(name + ".toml", std::move(scenario));
}

}  // namespace mrose
