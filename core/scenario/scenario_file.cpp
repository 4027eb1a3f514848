#include "scenario/scenario_file.h"

#include <algorithm>
#include <set>

#include "scenario/controller_file.h"
#include "scenario/description_reader.h"
#include "scenario/environment_file.h"
#include "scenario/robot_file.h"
#include "scenario/saved_state.h"
#include "scenario/start_check.h"
#include "scenario/state_validation.h"
#include "scenario/value_file.h"
#include "synthetic/reference_ball.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr std::int64_t mostNumber = 1'000'000;  // of a robot

/// As they are written; what is wrong with them is said where each is read.
std::vector<NamedRobot> robotsNamedIn(const Value& content) {
    std::vector<NamedRobot> robots;
    for (const char* const kind : {"robot", "person"}) {
        const Value* const all = content.find(kind);
        if (all == nullptr || all->asArray() == nullptr) continue;
        for (const Value& robot : *all->asArray()) {
            const auto textOf = [&](const char* key) {
                const Value* const value = robot.find(key);
                return value != nullptr && value->asText() != nullptr ? *value->asText() : std::string();
            };
            robots.push_back({textOf("name"), textOf("team")});
        }
    }
    return robots;
}

class ScenarioReader {
public:
    ScenarioReader(const ScenarioValue& value, DescriptionLibrary& library, const ScenarioLoading& loading)
        : name_(value.name()),
          library_(library),
          loading_(loading),
          root_(openDescription(value.content(), library.shown(value.name()), DescriptionKind::scenario)),
          robots_(robotsNamedIn(value.content())) {}

    Expected<LoadedScenario> read();

private:
    void readRun();
    void readRadio();
    void readEnvironment();
    void readRobot(TomlTable& table, bool person);
    void readObject(TomlTable& table);
    std::string bodyName(TomlTable& table);
    const RobotDescription* robotDescription(TomlTable& table);
    const RobotDescription* withOwnNetwork(TomlTable& table, const RobotDescription* robot);
    std::uint32_t typeIndex(const RobotDescription& robot, bool person);
    struct DrawnNoise {
        MotionDraw learned;  ///< of what the network knows
        MotionNoise constant;
    };
    DrawnNoise drawnNoise(TomlTable& table, const RobotDescription& robot, bool playsLog);
    std::uint32_t modelIndex(const RobotDescription& robot, const std::string& motionRobot, const DrawnNoise& noise);
    std::string motionRobot(TomlTable& table, const RobotDescription& robot);
    std::int64_t phase(TomlTable& table, const MotionModel& model);
    void readNumber(TomlTable& table, SceneRobot& robot);
    ObjectType objectType(TomlTable& table);
    std::uint32_t objectTypeIndex(ObjectType type);
    void ballsFirst();
    double ballRadius() const;
    void checkTeams();
    void checkStarts();
    void readSavedState();

    const std::string& name_;  ///< of the scenario's file
    DescriptionLibrary& library_;
    const ScenarioLoading& loading_;
    TomlTable root_;
    std::vector<NamedRobot> robots_;
    ScenarioParts parts_;
    Scene& scene_ = parts_.scene;
    std::vector<TomlTable> robotTables_, objectTables_;  ///< of the scene's bodies
    std::set<std::string> names_;
    std::shared_ptr<const FloorPlan> walls_;
    std::map<Value::File, RobotDescription> descriptions_;
    std::map<std::pair<const RobotDescription*, const MotionNetwork*>, RobotDescription> moved_;  ///< by own networks
    std::map<std::pair<const RobotDescription*, bool>, std::uint32_t> types_;
    std::map<std::tuple<const void*, std::string, MotionNoise, MotionDraw>, std::uint32_t> models_;
};

void ScenarioReader::readRun() {
    parts_.name = name(root_, "name");
    parts_.seed = static_cast<std::uint64_t>(root_.integerOr("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
    parts_.duration = durationOr(root_, "duration_s", parts_.duration, {0.001, 1e6});
    parts_.kickOff = root_.booleanOr("kick_off", parts_.kickOff);
    if (root_.has("variation")) {
        TomlTable table = root_.table("variation");
        Variation& variation = parts_.variation;
        variation.robotPosition = table.numberOr("robot_position_m", 0, {0, 1000});
        variation.robotHeading = angleOr(table, "robot_heading_deg", 0, {0, 180});
        variation.objectPosition = table.numberOr("object_position_m", 0, {0, 1000});
        variation.frictionShare = table.numberOr("friction_share", 0, {0, 0.99});
        variation.massShare = table.numberOr("mass_share", 0, {0, 0.99});
        table.rejectUnknown();
    }
    scene_.tickLength = durationOr(root_, "tick_s", scene_.tickLength, {0.001, 0.1});
    scene_.randomFactor = root_.numberOr("random_factor", 0, {0, 1});
}

void ScenarioReader::readRadio() {
    if (!root_.has("radio")) return;
    TomlTable table = root_.table("radio");
    Radio& radio = scene_.radio;
    constexpr double longest = static_cast<double>(Radio::mostDelay) / static_cast<double>(nanosecondsPerSecond);
    radio.latency = durationOr(table, "latency_s", radio.latency, {0, longest});
    radio.jitter = durationOr(table, "jitter_s", radio.jitter, {0, longest});
    radio.loss = table.numberOr("loss", radio.loss, {0, 1});
    radio.range = table.numberOr("range_m", radio.range, {0, 1e6});
    constexpr auto most = static_cast<std::int64_t>(RadioMessage::most);
    radio.messageBytes = static_cast<std::size_t>(table.integerOr("message_bytes", most, 1, most));
    table.rejectUnknown();
}

void ScenarioReader::readEnvironment() {
    const Value::File file =
        library_.file(root_, "environment", name_, "resources/environments", DescriptionLibrary::Holds::tables);
    if (!file) return;
    auto environment = mrose::readEnvironment(file->content, library_.shown(file->name));
    if (!environment) return root_.adopt(library_.saysWhoNames(environment.error(), file, name_, "environment"));
    scene_.environment = std::move(*environment);
    std::vector<ConvexPiece> pieces;
    for (const Obstacle& obstacle : scene_.environment.obstacles)
        pieces.insert(pieces.end(), obstacle.shape.pieces.begin(), obstacle.shape.pieces.end());
    walls_ = std::make_shared<const FloorPlan>(std::move(pieces));
}

std::string ScenarioReader::bodyName(TomlTable& table) {
    std::string called = name(table, "name");
    if (!table.failed() && !names_.insert(called).second)
        table.reject("name", '"' + called + "\" is the name of another robot, person or object too");
    return called;
}

const RobotDescription* ScenarioReader::robotDescription(TomlTable& table) {
    const Value::File file = library_.file(table, "type", name_, "resources/robots", DescriptionLibrary::Holds::tables);
    if (!file) return nullptr;
    auto found = descriptions_.find(file);
    if (found == descriptions_.end()) {
        auto robot = mrose::readRobot(file, library_);
        if (!robot) return table.adopt(library_.saysWhoNames(robot.error(), file, name_, "type")), nullptr;
        found = descriptions_.emplace(file, std::move(*robot)).first;
    }
    table.resolve("type", found->second.file);
    return &found->second;
}

/// The robot as it is moved by the network that the scenario names for it, if it does.
const RobotDescription* ScenarioReader::withOwnNetwork(TomlTable& table, const RobotDescription* robot) {
    if (!table.has("network")) return robot;
    const MotionNetwork* network = library_.network(table, "network", name_);
    if (network == nullptr) return nullptr;
    if (const auto found = moved_.find({robot, network}); found != moved_.end()) return &found->second;
    auto moved = movedBy(*network, *robot, library_);
    if (!moved) return table.reject("network", moved.error().cause), nullptr;
    return &moved_.emplace(std::pair(robot, network), std::move(*moved)).first->second;
}

std::uint32_t ScenarioReader::typeIndex(const RobotDescription& robot, bool person) {
    const auto [type, added] =
        types_.emplace(std::pair(&robot, person), static_cast<std::uint32_t>(scene_.robotTypes.size()));
    if (added) {
        scene_.robotTypes.push_back(robot.type);
        scene_.robotTypes.back().person = person;
    }
    return type->second;
}

std::string ScenarioReader::motionRobot(TomlTable& table, const RobotDescription& robot) {
    std::string chosen = nameOr(table, "motion_robot", robot.motionRobot);
    if (!table.has("motion_robot") || table.failed()) return chosen;
    if (!robot.motion)
        table.reject("motion_robot", "its robot file has no network to choose a robot of");
    else if (robot.motion->inputs().robotIndex(chosen) < 0)
        table.reject("motion_robot", "\"" + chosen + "\" is none of the network's robots");
    return chosen;
}

/// A robot that plays a log is compared with the real one: its network's mean moves it. Where the scenario says how it
/// moves, the robot file's constant noise does not count.
ScenarioReader::DrawnNoise ScenarioReader::drawnNoise(TomlTable& table, const RobotDescription& robot, bool playsLog) {
    if (!table.has("learned_noise")) return {playsLog ? MotionDraw::mean : robot.motionDraw, robot.motionNoise};
    const bool drawn = table.boolean("learned_noise");
    if (drawn && !(robot.motion && robot.motion->network().noise))
        table.reject("learned_noise", "is true; the robot moves by no network that knows its noise");
    return {drawn ? MotionDraw::noisy : MotionDraw::mean, {}};
}

std::uint32_t ScenarioReader::modelIndex(const RobotDescription& robot, const std::string& motionRobot,
                                         const DrawnNoise& noise) {
    const void* const motion = robot.motion ? static_cast<const void*>(robot.motion.get()) : robot.model.get();
    const auto [model, added] = models_.emplace(std::tuple(motion, motionRobot, noise.constant, noise.learned),
                                                static_cast<std::uint32_t>(scene_.models.size()));
    if (!added) return model->second;
    std::shared_ptr<const MotionModel> own = robot.model;
    if (robot.motion) own = std::make_shared<const LearnedModel>(robot.motion, motionRobot, noise.learned);
    scene_.models.push_back(withNoise(std::move(own), noise.constant));
    return model->second;
}

/// Without a phase of its own each robot has one by the golden ratio: any number of them is spread over the period.
std::int64_t ScenarioReader::phase(TomlTable& table, const MotionModel& model) {
    const Nanoseconds tick = scene_.tickLength;
    const std::int64_t ticks = model.period() / tick;
    if (table.has("phase_s") && table.has("phase_share"))
        table.reject("phase_share", "phase_s is there too; expected one of them");
    if (table.has("phase_s")) {
        const Nanoseconds phase = duration(table, "phase_s", {0, 10});
        if (phase % tick != 0 || phase >= model.period())
            table.reject("phase_s",
                         "expected a multiple of tick_s below the control period of " + plainSeconds(model.period()));
        return phase / tick;
    }
    const double golden = static_cast<double>(scene_.robots.size()) * 0.618033988749895;
    const double share = table.numberOr("phase_share", golden - std::floor(golden), {0, 1});
    return std::min(static_cast<std::int64_t>(share * static_cast<double>(ticks)), ticks - 1);
}

void ScenarioReader::readNumber(TomlTable& table, SceneRobot& robot) {
    const std::size_t before = scene_.robots.empty() ? 0 : scene_.placeOf(scene_.robots.size() - 1) + 1;
    const auto least = static_cast<std::int64_t>(before) + 1;
    const auto place = static_cast<std::uint32_t>(table.integerOr("number", least, least, mostNumber) - 1);
    if (place != scene_.robots.size()) robot.place = place;
}

void ScenarioReader::readRobot(TomlTable& table, bool person) {
    SceneRobot body;
    body.name = bodyName(table);
    const RobotDescription* const kind = robotDescription(table);
    if (kind == nullptr) return;
    const RobotDescription* const robot = withOwnNetwork(table, kind);
    if (robot == nullptr) return;
    if (robot->controlPeriod() % scene_.tickLength != 0)
        table.reject("type", "has a control period of " + plainSeconds(robot->controlPeriod()) +
                                 "; expected a multiple of tick_s = " + plainSeconds(scene_.tickLength));
    body.type = typeIndex(*kind, person);
    body.motionRobot = motionRobot(table, *robot);
    ControllerSetting setting{noController()};
    if (table.has("controller"))
        setting = readController(table.table("controller"),
                                 {*robot, ballRadius(), walls_, scene_.environment, robots_, scene_.robots.size()},
                                 name_, library_, loading_);
    body.model = modelIndex(*robot, body.motionRobot, drawnNoise(table, *robot, setting.played.has_value()));
    if (setting.logStart && !table.has("start"))
        body.start = *setting.logStart;
    else
        body.start = pose(table.table("start"));
    body.sent = std::move(setting.sent);
    body.phase = phase(table, *scene_.models[body.model]);
    if (table.has("team")) body.team = name(table, "team");
    readNumber(table, body);
    table.rejectUnknown();
    if (setting.played)
        parts_.players.push_back({static_cast<std::uint32_t>(scene_.robots.size()), std::move(*setting.played)});
    scene_.robots.push_back(std::move(body));
    parts_.controllers.push_back(std::move(setting.controller));
    robotTables_.push_back(table);
}

ObjectType ScenarioReader::objectType(TomlTable& table) {
    ObjectType type;
    type.rolls = table.has("kind") ? table.choice("kind", {"ball", "box"}) == 0 : true;
    type.shape = library_.shape(table, "shape", name_);
    type.mass = table.number("mass_kg", {0.001, 1e5});
    type.surface = surfaceOr(table, "surface", type.surface);
    if (type.rolls) type.inertia = table.numberOr("inertia", type.inertia, {0.01, 1});
    if (table.has("motion") && table.choice("motion", {"floor", "reference"}) == 1) {
        if (!type.rolls) table.reject("motion", "of a box can only be \"floor\": the reference ball is no box");
        type.motion = referenceBall();
    }
    if (!type.shape || !type.rolls) return type;
    type.name = type.shape->name;
    const bool round =
        type.shape->parts.size() == 1 && type.shape->parts[0].polygon.empty() && type.shape->parts[0].centre == Point{};
    if (!round) table.reject("shape", "is no circle about its reference point; expected one, for a ball");
    return type;
}

std::uint32_t ScenarioReader::objectTypeIndex(ObjectType type) {
    if (type.shape) type.name = type.shape->name;
    const auto same = [&](const ObjectType& other) {
        return other.shape == type.shape && other.mass == type.mass && other.surface == type.surface &&
               other.rolls == type.rolls && other.inertia == type.inertia && other.motion == type.motion;
    };
    const auto found = std::find_if(scene_.objectTypes.begin(), scene_.objectTypes.end(), same);
    const auto index = static_cast<std::uint32_t>(found - scene_.objectTypes.begin());
    if (found == scene_.objectTypes.end()) scene_.objectTypes.push_back(std::move(type));
    return index;
}

void ScenarioReader::readObject(TomlTable& table) {
    SceneObject object;
    object.name = bodyName(table);
    object.type = objectTypeIndex(objectType(table));
    object.start = pose(table.table("start"));
    if (table.has("velocity")) {
        TomlTable velocity = table.table("velocity");
        object.velocity_W = {velocity.numberOr("x_mps", 0, {-20, 20}), velocity.numberOr("y_mps", 0, {-20, 20}),
                             angleOr(velocity, "rotation_degps", 0, {-3600, 3600})};
        velocity.rejectUnknown();
    }
    table.rejectUnknown();
    scene_.objects.push_back(std::move(object));
    objectTables_.push_back(table);
}

/// Robots know the ball as object 0.
void ScenarioReader::ballsFirst() {
    std::vector<std::size_t> order(scene_.objects.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return scene_.typeOfObject(i).rolls; });
    std::vector<SceneObject> objects;
    std::vector<TomlTable> tables;
    for (const std::size_t i : order) {
        objects.push_back(scene_.objects[i]);
        tables.push_back(objectTables_[i]);
    }
    scene_.objects = std::move(objects);
    objectTables_ = std::move(tables);
}

double ScenarioReader::ballRadius() const {
    const bool ball = !scene_.objects.empty() && scene_.typeOfObject(0).rolls;
    return ball ? scene_.typeOfObject(0).shape->reach : 0;
}

void ScenarioReader::checkTeams() {
    std::map<std::string_view, std::size_t> sizes;
    for (const SceneRobot& robot : scene_.robots) ++sizes[robot.team];
    for (std::size_t i = 0; i < scene_.robots.size(); ++i)
        if (const std::string& team = scene_.robots[i].team; !team.empty() && sizes[team] == 1)
            return robotTables_[i].reject(
                "team", "no other robot is of team \"" + team + "\"; expected one to talk to, or no team");
}

void ScenarioReader::checkStarts() {
    if (!loading_.playLogs && !parts_.players.empty()) return;  // it is not known yet where they start
    const auto overlap = findStartOverlap(scene_);
    if (!overlap) return;
    const std::size_t robots = scene_.robots.size();
    const auto bodyName = [&](std::size_t body) {
        return '"' + (body < robots ? scene_.robots[body].name : scene_.objects[body - robots].name) + '"';
    };
    TomlTable& table = overlap->body < robots ? robotTables_[overlap->body] : objectTables_[overlap->body - robots];
    const std::string other = overlap->other
                                  ? bodyName(*overlap->other)
                                  : "the obstacle \"" + scene_.environment.obstacles[overlap->obstacle].name + '"';
    const long millimetres = std::max(1l, std::lround(overlap->depth * 1000));
    table.reject("start", bodyName(overlap->body) + " overlaps " + other + " by about " + std::to_string(millimetres) +
                              " mm; expected room between them");
}

/// What the bodies' starts are then is where the state has them; after a goal the objects still go where the file says.
void ScenarioReader::readSavedState() {
    const Value::File file =
        library_.file(root_, "initial_state", name_, "resources/scenarios", DescriptionLibrary::Holds::text);
    if (!file || root_.failed()) return;
    auto saved = parseSavedState(*file->content.asText(), library_.shown(file->name));
    if (!saved) return root_.adopt(saved.error());
    if (!loading_.playLogs) return;
    if (const std::string wrong = unfit(*saved, scene_); !wrong.empty()) return root_.reject("initial_state", wrong);
    for (const SceneObject& object : scene_.objects) parts_.kickOffPoses.push_back(object.start);
    for (std::size_t i = 0; i < scene_.robots.size(); ++i) scene_.robots[i].start = saved->state.robots[i].pose;
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) scene_.objects[i].start = saved->state.objects[i].pose;
    if (!root_.has("seed")) parts_.seed = saved->state.seed;
    parts_.saved = std::make_shared<const SavedState>(std::move(*saved));
    const Scenario scenario(parts_);
    if (const std::string wrong = validate(scenario, scenario.initialState()); !wrong.empty())
        root_.reject("initial_state", "does not fit the scenario: it has " + wrong);
}

Expected<LoadedScenario> ScenarioReader::read() {
    readRun();
    readRadio();
    readEnvironment();
    for (TomlTable& table : root_.tablesOrNone("object"))
        if (!root_.failed()) readObject(table);
    if (!root_.failed()) ballsFirst();
    for (const auto& [key, person] : {std::pair("robot", false), std::pair("person", true)})
        for (TomlTable& table : root_.tablesOrNone(key))
            if (!root_.failed()) readRobot(table, person);
    if (!root_.failed()) checkTeams();
    const bool goesOn = root_.has("initial_state");
    if (goesOn && !root_.failed()) readSavedState();
    root_.rejectUnknown();
    if (!root_.failed() && !goesOn && loading_.checkStarts) checkStarts();
    if (root_.failed()) return tl::unexpected(root_.error());
    return LoadedScenario{ScenarioValue(name_, root_.resolved()), std::move(parts_)};
}

}  // namespace

Expected<LoadedScenario> loadScenario(const std::string& name, DescriptionSource& source,
                                      const ScenarioLoading& loading) {
    DescriptionLibrary library(source);
    constexpr std::string_view folders[] = {"resources/scenarios"};
    const auto file = library.file(name, folders);
    if (!file) return tl::unexpected(file.error());
    const auto value = scenarioOf(*file, library.shown((*file)->name));
    if (!value) return tl::unexpected(value.error());
    return ScenarioReader(*value, library, loading).read();
}

Expected<LoadedScenario> loadScenario(const ScenarioValue& value, DescriptionSource& source,
                                      const ScenarioLoading& loading) {
    DescriptionLibrary library(source);
    return loadScenario(value, library, loading);
}

Expected<LoadedScenario> loadScenario(const ScenarioValue& value, DescriptionLibrary& library,
                                      const ScenarioLoading& loading) {
    return ScenarioReader(value, library, loading).read();
}

Expected<LoadedScenario> loadScenario(const ScenarioValue& value, const ScenarioLoading& loading) {
    NoDescriptions none;
    return loadScenario(value, none, loading);
}

}  // namespace mrose
