#include "scenario/robot_file.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"
#include "motion/kinematic.h"
#include "scenario/delayed_network.h"
#include "scenario/description_reader.h"
#include "sensing/sensor_kinds.h"
#include "synthetic/reference_model.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr NumberRange seconds{0, 2};
constexpr NumberRange anyAngle{-360, 360};

/// Dead times of a robot's two channels.
struct DeadTimes {
    double v = 0, w = 0;  ///< s
};

/// What was identified of one of the network's robots, or of all in the mean; nullopt where the file says nothing.
std::optional<DeadTimes> identifiedDeadTimes(const MotionNetwork& network, const std::string& robot) {
    DeadTimes sum;
    double count = 0;
    for (const MotionNetwork::Identified& identified : network.identified) {
        if (!robot.empty() && identified.robot != robot) continue;
        sum.v += identified.v.deadTime;
        sum.w += identified.w.deadTime;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return DeadTimes{sum.v / count, sum.w / count};
}

/// The dead times that a robot file sets in the place of its network's own.
std::optional<DeadTimes> readDeadTimes(TomlTable& motion) {
    if (!motion.has("dead_time")) return std::nullopt;
    TomlTable table = motion.table("dead_time");
    const DeadTimes own{table.number("v_s", seconds), table.number("w_s", seconds)};
    if (!table.booleanOr("override", false))
        table.reject("override",
                     "is not true; the network has its own dead time, and only `override = true` beside "
                     "another one replaces it");
    table.rejectUnknown();
    return own;
}

std::string robotNames(const MotionNetwork& network) {
    std::string names;
    for (const std::string& robot : network.robots) names += (names.empty() ? "\"" : ", \"") + robot + '"';
    return names.empty() ? "none" : names;
}

void readLearned(TomlTable& root, TomlTable& table, RobotDescription& robot, const DescriptionFile& file,
                 DescriptionLibrary& library, DeadTimes& deadTimes) {
    const MotionNetwork* network = library.network(table, "network", file.name);
    robot.motionRobot = nameOr(table, "robot", "");
    const auto wanted = readDeadTimes(table);
    table.rejectUnknown();
    if (network == nullptr || root.failed()) return;
    if (!robot.motionRobot.empty() &&
        std::find(network->robots.begin(), network->robots.end(), robot.motionRobot) == network->robots.end())
        table.reject("robot", "is none of the network's robots: " + robotNames(*network));
    const Nanoseconds period = durationOr(root, "control_period_s", network->period, {0.001, 10});
    if (period != network->period)
        root.reject("control_period_s",
                    "is " + plainSeconds(period) + "; the network was learned for " + plainSeconds(network->period));
    const auto identified = identifiedDeadTimes(*network, robot.motionRobot);
    deadTimes = wanted.value_or(identified.value_or(DeadTimes{}));
    Nanoseconds laterV = 0, laterW = 0;
    if (wanted && !identified)
        table.reject("dead_time", "the network does not say its own, so that it cannot be replaced");
    if (wanted && identified) {
        laterV = fromSeconds(wanted->v - identified->v);
        laterW = fromSeconds(wanted->w - identified->w);
    }
    if (!canDelay(*network, laterV, laterW))
        table.reject("dead_time", "the network's is " + numberText(identified->v) + " and " +
                                      numberText(identified->w) +
                                      "; its inputs cannot be shifted by the differences to this one");
    if (!root.failed()) robot.motion = library.motion(*network, laterV, laterW);
}

KinematicParameters::Channel readChannel(TomlTable table, bool rotation) {
    const double unit = rotation ? radians(1) : 1;
    const auto key = [&](const char* of, const char* straight, const char* turning) {
        return std::string(of) + (rotation ? turning : straight);
    };
    KinematicParameters::Channel channel;
    channel.deadTime = table.numberOr("dead_time_s", 0, seconds);
    channel.lag = table.numberOr("lag_s", 0, {0, 10});
    channel.gain = table.numberOr("gain", 1, {0, 10});
    channel.bias = unit * table.numberOr(key("bias", "_mps", "_degps"), 0, {-100, 100});
    channel.limit = unit * table.numberOr(key("limit", "_mps", "_degps"), 0, {0, 3600});
    channel.acceleration = unit * table.numberOr(key("acceleration", "_mps2", "_degps2"), 0, {0, 36000});
    table.rejectUnknown();
    return channel;
}

void readKinematics(TomlTable& root, RobotDescription& robot, DeadTimes& deadTimes) {
    TomlTable table = root.table("kinematics");
    KinematicParameters parameters;
    parameters.v = readChannel(table.tableOrEmpty("v"), false);
    parameters.w = readChannel(table.tableOrEmpty("w"), true);
    parameters.lateralPerRotation = table.numberOr("lateral_per_rotation_m", 0, {-10, 10});
    table.rejectUnknown();
    deadTimes = {parameters.v.deadTime, parameters.w.deadTime};
    const Nanoseconds period = duration(root, "control_period_s", {0.001, 10});
    if (!root.failed()) robot.model = std::make_shared<const KinematicModel>(parameters, period);
}

void readReference(TomlTable& root, TomlTable& table, RobotDescription& robot, DeadTimes& deadTimes) {
    table.rejectUnknown();
    const double longest = toSeconds(ReferenceModel::longestPeriod), step = toSeconds(ReferenceRobot::step);
    const Nanoseconds period = durationOr(root, "control_period_s", 100'000'000, {step, longest});
    if (period % ReferenceRobot::step != 0)
        root.reject("control_period_s", "expected a multiple of the reference robot's step of " +
                                            plainSeconds(ReferenceRobot::step) + " s");
    robot.model = std::make_shared<const ReferenceModel>(period);
    const MotionModel::DeadTimes own = robot.model->deadTimes();
    deadTimes = {toSeconds(own.v), toSeconds(own.w)};
}

void readMotion(TomlTable& root, RobotDescription& robot, const DescriptionFile& file, DescriptionLibrary& library,
                DeadTimes& deadTimes) {
    root.expectOneOf("kinematics", "motion", "[motion] or [kinematics]");
    if (root.has("kinematics")) return readKinematics(root, robot, deadTimes);
    if (!root.has("motion")) return;
    TomlTable table = root.table("motion");
    if (table.has("model") && table.choice("model", {"network", "reference"}) == 1)
        readReference(root, table, robot, deadTimes);
    else
        readLearned(root, table, robot, file, library, deadTimes);
}

/// The noise that a network has learned is drawn unless the file says otherwise, or has constant noise in its place.
void readMotionNoise(TomlTable table, RobotDescription& robot) {
    MotionNoise& noise = robot.motionNoise;
    noise.distancePerDistance = table.numberOr("distance_per_distance", 0, {0, 1});
    noise.rotationPerRotation = table.numberOr("rotation_per_rotation", 0, {0, 1});
    noise.rotationPerDistance = angleOr(table, "rotation_per_distance_degpm", 0, {0, 360});
    const bool known = robot.motion && robot.motion->network().noise;
    const bool learned = table.has("learned") ? table.boolean("learned") : noise.none();
    if (learned && !known && table.has("learned"))
        table.reject("learned", robot.motion ? "is true; the network knows its mean alone"
                                             : "is true; the robot does not move by a network");
    robot.motionDraw = learned ? MotionDraw::noisy : MotionDraw::mean;
    table.rejectUnknown();
}

/// What the network says is usual.
void takeFrom(const KickNetwork& network, Manipulator& manipulator) {
    manipulator.direction = network.direction;
    manipulator.speed = network.constant.speedAtFull;
    manipulator.deadTime = fromSeconds(network.constant.deadTime);
    const bool across = std::abs(cosine(network.direction)) < 0.7;
    const KickNetwork::Range& wide = network.seen[across ? 3 : 4];
    manipulator.width = wide.most - wide.least;
}

void readLearnedKicker(TomlTable& table, Manipulator& manipulator, const std::string& from,
                       DescriptionLibrary& library) {
    for (const char* const known : {"direction_deg", "speed_mps", "reach_m", "width_m", "dead_time_s"})
        if (table.has(known)) table.reject(known, "is not for a kicker with a network, which says it");
    manipulator.recharge = durationOr(table, "recharge_s", manipulator.recharge, {0, 3600});
    manipulator.learned = library.kicker(table, "network", from);
    table.rejectUnknown();
    if (manipulator.learned) takeFrom(manipulator.learned->network(), manipulator);
}

Manipulator readManipulator(TomlTable& table, const DeadTimes& deadTimes, const std::string& from,
                            DescriptionLibrary& library) {
    Manipulator manipulator;
    manipulator.name = name(table, "name");
    manipulator.position = point(table, "position_m", shapeReach);
    if (table.has("network")) {
        readLearnedKicker(table, manipulator, from, library);
        return manipulator;
    }
    manipulator.direction = angleOr(table, "direction_deg", 0, anyAngle);
    manipulator.speed = table.number("speed_mps", {0, 20});
    manipulator.reach = table.numberOr("reach_m", manipulator.reach, {0.001, 10});
    manipulator.width = table.numberOr("width_m", manipulator.width, {0.001, 10});
    manipulator.recharge = durationOr(table, "recharge_s", manipulator.recharge, {0, 3600});
    manipulator.deadTime = durationOr(table, "dead_time_s", fromSeconds(deadTimes.v), seconds);
    table.rejectUnknown();
    return manipulator;
}

void readManipulators(TomlTable& root, RobotType& type, const DeadTimes& deadTimes, const std::string& from,
                      DescriptionLibrary& library) {
    std::vector<TomlTable> tables = root.tablesOrNone("manipulator");
    if (tables.size() > maxManipulators)
        root.reject("manipulator",
                    "has " + std::to_string(tables.size()) + "; expected at most " + std::to_string(maxManipulators));
    for (TomlTable& table : tables) {
        Manipulator manipulator = readManipulator(table, deadTimes, from, library);
        const auto same = [&](const Manipulator& other) { return other.name == manipulator.name; };
        if (std::any_of(type.manipulators.begin(), type.manipulators.end(), same))
            table.reject("name", "\"" + manipulator.name + "\" is the name of another manipulator too");
        type.manipulators.push_back(std::move(manipulator));
    }
}

}  // namespace

Expected<RobotDescription> readRobot(const Value::File& file, DescriptionLibrary& library) {
    TomlTable root = openDescription(file->content, library.shown(file->name), DescriptionKind::robot);
    RobotDescription robot;
    RobotType& type = robot.type;
    DeadTimes deadTimes;
    type.name = name(root, "name");
    if (root.has("kind")) robot.kind = readRobotKind(root.table("kind"), file->name.substr(file->name.rfind('/') + 1));
    type.shape = library.shape(root, "shape", file->name);
    type.mass = root.number("mass_kg", {0.001, 1e5});
    type.surface = surfaceOr(root, "surface", type.surface);
    if (!root.failed()) readMotion(root, robot, *file, library, deadTimes);
    robot.deadTime = (deadTimes.v + deadTimes.w) / 2;
    readMotionNoise(root.tableOrEmpty("motion_noise"), robot);
    readManipulators(root, type, deadTimes, file->name, library);
    type.perception = readPerception(root.tableOrEmpty("perception"));
    type.sensors = readSensors(root.tablesOrNone("sensor"), library.sensorSources(file->name, type.shape));
    root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    robot.file = std::make_shared<const DescriptionFile>(DescriptionFile{file->name, file->reference, root.resolved()});
    return robot;
}

std::string motionKind(const RobotDescription& robot) {
    if (robot.motion) return "learned motion";
    const bool reference = dynamic_cast<const ReferenceModel*>(robot.model.get()) != nullptr;
    return reference ? "motion of the reference robot, synthetic" : "kinematic motion";
}

Expected<RobotDescription> movedBy(const MotionNetwork& network, RobotDescription robot, DescriptionLibrary& library) {
    if (network.period != robot.controlPeriod())
        return fail("", "was learned for a control period of " + plainSeconds(network.period) + " s; the robot's is " +
                            plainSeconds(robot.controlPeriod()) + " s");
    robot.motion = library.motion(network, 0, 0);
    robot.model = nullptr;
    if (robot.motion->inputs().robotIndex(robot.motionRobot) < 0) robot.motionRobot.clear();
    const DeadTimes own = identifiedDeadTimes(network, robot.motionRobot).value_or(DeadTimes{});
    robot.deadTime = (own.v + own.w) / 2;
    return robot;
}

}  // namespace mrose
