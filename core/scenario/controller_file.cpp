#include "scenario/controller_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "behaviour/chase_ball.h"
#include "behaviour/command_player.h"
#include "behaviour/dynamic_window.h"
#include "behaviour/free_ball.h"
#include "behaviour/go_to_pose.h"
#include "behaviour/navigate.h"
#include "behaviour/team_player.h"
#include "behaviour/wander.h"
#include "behaviour/way_to_ball.h"
#include "io/toml_text.h"
#include "motion/kinematic.h"
#include "plugin/load_plugin.h"
#include "scenario/ball_contact.h"
#include "scenario/description_reader.h"
#include "scenario/log_excerpt.h"
#include "scenario/obstacle_sensors.h"
#include "sensing/sensor.h"

namespace mrose {
namespace {

constexpr NumberRange speeds{0, 20};
constexpr NumberRange rotations{0, 3600};
constexpr NumberRange runTime{0, 1e6};
constexpr NumberRange deadTimes{0, 2};
constexpr std::size_t mostTargets = 1000;
constexpr NumberRange weights{0, 100};
constexpr double leastHorn = 0.03;  // m, before the front
constexpr const char* noGuide = "the robot has no ball guide; expected horns that reach 3 cm farther than its front";

/// Stands in for a plug-in that is not to be loaded: it decides nothing.
class AbsentController final : public Controller {
public:
    Attention attention() const override { return Attention::ofItself(); }
    void decide(const Observation&, std::span<std::byte>, Decision&) const override {}
};

struct Context {
    TomlTable& table;
    const DrivenRobot& driven;
    const std::string& from;  ///< the scenario file's name
    DescriptionLibrary& library;
    const ScenarioLoading& loading;
};

ControllerSetting velocityScript(const Context& context) {
    std::vector<StampedCommand> commands;
    for (TomlTable& row : context.table.tables("commands")) {
        const Nanoseconds time = duration(row, "t_s", runTime);
        const Command command{row.numberOr("v_mps", 0, {-20, 20}), angleOr(row, "w_degps", 0, {-3600, 3600})};
        row.rejectUnknown();
        if (!commands.empty() && time <= commands.back().time)
            row.reject("t_s", "is not later than that of the command before");
        commands.push_back({time, command});
    }
    if (context.table.failed()) return {};
    return {std::make_shared<CommandPlayer>(commands)};
}

/// Itself, and of each name in `reads` the readings of the sensor that is called so, or the reading. What this robot
/// does not have is passed over: the log's may have had more sensors.
Attention playersAttention(TomlTable& table, const RobotType& type) {
    Attention attention = Attention::ofItself();
    if (!table.has("reads")) return attention;
    const std::vector<std::string> names = table.strings("reads");
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i].size() > ReadingName::most) {
            table.rejectElement("reads", i, "is too long for a sensor or a reading");
            return attention;
        }
        attention.names.emplace_back(names[i]);
        for (const SensorPointer& sensor : type.sensors)
            if (sensor->name() == names[i])
                for (const ReadingKind& kind : sensor->gives()) attention.names.push_back(kind.name);
    }
    return attention;
}

ControllerSetting logPlayer(const Context& context) {
    TomlTable& table = context.table;
    LogExcerpt excerpt;
    const Value* const log = table.value("log");
    const DescriptionFile* const included = log ? log->asFile() : nullptr;
    excerpt.reference = included ? included->reference : table.string("log");
    excerpt.log = included ? included->name : joinedName(context.from, excerpt.reference);
    excerpt.robot = name(table, "robot");
    excerpt.trajectory = nameOr(table, "trajectory", "");
    excerpt.start = table.numberOr("start_s", 0, {-runTime.most, runTime.most});
    if (const auto& motion = context.driven.robot.motion) excerpt.drive = motion->network().drive;
    Attention reads = playersAttention(table, context.driven.robot.type);
    if (table.failed()) return {};
    if (!context.loading.playLogs)
        return {std::make_shared<CommandPlayer>(std::vector<StampedCommand>(), std::move(reads)), Pose{}, excerpt};
    auto content = included ? parseExcerpt(included->content) : std::optional<ExcerptContent>();
    if (included && !content) table.reject("log", "does not hold commands");
    if (!included) {
        auto found = context.library.excerpt(excerpt);
        if (!found) return table.adopt(found.error()), ControllerSetting{};
        content = std::move(*found);
        if (content)
            table.resolve("log", std::make_shared<const DescriptionFile>(
                                     DescriptionFile{excerpt.log, excerpt.reference, excerptValue(*content)}));
    }
    if (!content) {
        table.reject("log",
                     '"' + excerpt.reference +
                         "\" was not found; expected a log of that name beside this file, in the current folder or "
                         "in the folder that MROSE_DATA names, or another one by --log");
        return {};
    }
    std::vector<StampedCommand> sent = content->commands;
    std::erase_if(sent, [](const StampedCommand& command) { return command.time > 0; });
    return {std::make_shared<CommandPlayer>(content->commands, std::move(reads)), content->start, excerpt,
            std::move(sent)};
}

ControllerSetting goToPose(const Context& context) {
    GoToPose::Options options;
    TomlTable& table = context.table;
    std::vector<TomlTable> targets = table.tables("targets");
    if (targets.empty() || targets.size() > mostTargets) table.reject("targets", "expected 1 to 1000 poses");
    for (const TomlTable& target : targets) options.targets.push_back(pose(target));
    options.loop = table.booleanOr("loop", options.loop);
    options.backwards = table.booleanOr("backwards", options.backwards);
    options.speed = table.numberOr("speed_mps", options.speed, speeds);
    options.rotation = angleOr(table, "rotation_degps", options.rotation, rotations);
    options.tolerance = table.numberOr("tolerance_m", options.tolerance, {0.001, 10});
    options.headingTolerance = angleOr(table, "heading_tolerance_deg", options.headingTolerance, {0.1, 360});
    options.ball = context.driven.ballRadius > 0;
    options.radius = context.driven.robot.type.shape->reach;
    options.walls = context.driven.walls;
    options.deadTime = table.numberOr("dead_time_s", context.driven.robot.deadTime, deadTimes);
    return {std::make_shared<GoToPose>(std::move(options))};
}

/// What a shape's points have of something at most.
template <class Measure>
double mostOf(const Shape& shape, Measure measure) {
    double result = 0;
    for (const ConvexPiece& piece : shape.pieces)
        for (std::size_t i = 0; i < piece.count; ++i)
            result = std::max(result, measure(piece.corners[i]) + piece.radius);
    return result;
}

/// Whether it has horns, between which a ball comes along.
bool hasGuide(const Shape& shape, double front) {
    return mostOf(shape, [](const Point& p) { return p.x; }) > front + leastHorn;
}

/// How a robot with a guide strikes a ball off a wall.
WallStroke::Options wallStroke(TomlTable& table, const Context& context) {
    WallStroke::Options options;
    options.reach = context.driven.robot.type.shape->reach;
    if (context.driven.ballRadius > 0) options.ballRadius = context.driven.ballRadius;
    options.standOff = table.numberOr("stand_off_m", options.standOff, {0.1, 2});
    options.stopDistance = table.numberOr("stop_distance_m", options.stopDistance, {0.05, 2});
    options.approach = angleOr(table, "approach_deg", options.approach, {-90, 90});
    options.tolerance = table.numberOr("tolerance_m", options.tolerance, {0.005, 0.5});
    options.lead = table.numberOr("lead_s", options.lead, {0, 2});
    options.leadSpeed = table.numberOr("lead_speed_mps", options.leadSpeed, {-1, 1});
    options.turnSpeed = table.numberOr("turn_speed_mps", options.turnSpeed, {-1, 1});
    options.strokeRotation = angleOr(table, "stroke_degps", options.strokeRotation, {10, 720});
    options.turn = angleOr(table, "turn_deg", options.turn, {5, 360});
    options.follow = table.numberOr("follow_s", options.follow, {0, 5});
    return options;
}

ChaseBall::Options chasing(const Context& context) {
    ChaseBall::Options options;
    TomlTable& table = context.table;
    options.target = point(table, "target_m", metresFar);
    options.speed = table.numberOr("speed_mps", options.speed, speeds);
    options.rotation = angleOr(table, "rotation_degps", options.rotation, rotations);
    options.kicks = table.booleanOr("kicks", options.kicks);
    if (context.driven.ballRadius > 0) options.ballRadius = context.driven.ballRadius;
    if (const double front = ballContact(*context.driven.robot.type.shape, options.ballRadius); front > 0)
        options.front = front;
    const Shape& shape = *context.driven.robot.type.shape;
    options.halfWidth = mostOf(shape, [](const Point& p) { return std::abs(p.y); });
    options.guide = hasGuide(shape, options.front);
    if (table.booleanOr("walls", true)) options.walls = context.driven.walls;
    options.deadTime = table.numberOr("dead_time_s", context.driven.robot.deadTime, deadTimes);
    if (table.booleanOr("strokes", false)) {
        if (!options.guide) table.reject("strokes", noGuide);
        options.stroke = wallStroke(table, context);
        options.stroke->speed = options.speed;
        options.stroke->rotation = options.rotation;
    }
    return options;
}

ControllerSetting freeBall(const Context& context) {
    FreeBall::Options options;
    TomlTable& table = context.table;
    options.stroke = wallStroke(table, context);
    options.stroke.speed = table.numberOr("speed_mps", options.stroke.speed, speeds);
    options.stroke.rotation = angleOr(table, "rotation_degps", options.stroke.rotation, rotations);
    options.stroke.within = table.numberOr("free_m", 0.3, {0.02, 2});
    if (const double front = ballContact(*context.driven.robot.type.shape, options.stroke.ballRadius); front > 0)
        options.front = front;
    if (!hasGuide(*context.driven.robot.type.shape, options.front)) table.reject("kind", noGuide);
    if (table.has("towards_m")) options.towards = point(table, "towards_m", metresFar);
    options.walls = context.driven.walls;
    options.deadTime = table.numberOr("dead_time_s", context.driven.robot.deadTime, deadTimes);
    return {std::make_shared<FreeBall>(options)};
}

ControllerSetting chaseBall(const Context& context) { return {std::make_shared<ChaseBall>(chasing(context))}; }

/// Those that its messages reach, and itself; as of teamsOf().
std::vector<TeamPlayer::Member> teamOf(const DrivenRobot& driven) {
    const bool teams = std::ranges::any_of(driven.robots, [](const NamedRobot& robot) { return !robot.team.empty(); });
    const std::string& own = driven.robots[driven.index].team;
    std::vector<TeamPlayer::Member> team;
    for (std::size_t i = 0; i < driven.robots.size(); ++i)
        if (i == driven.index || !teams || (!own.empty() && driven.robots[i].team == own))
            team.push_back({static_cast<std::uint32_t>(i), driven.robots[i].name});
    return team;
}

ControllerSetting teamPlayer(const Context& context) {
    TeamPlayer::Options options;
    TomlTable& table = context.table;
    options.chase = chasing(context);
    options.ownGoal = -1 * options.chase.target;
    if (table.has("own_goal_m")) options.ownGoal = point(table, "own_goal_m", metresFar);
    options.keeper = table.booleanOr("keeper", options.keeper);
    options.team = teamOf(context.driven);
    if (options.team.size() > RoleChoice::most)
        table.reject("kind", "its team has " + std::to_string(options.team.size()) + " robots; expected at most " +
                                 std::to_string(RoleChoice::most) + ", with `team` in their tables");
    constexpr std::array choices{std::string_view("time"), std::string_view("nearest"),
                                 std::string_view("distance_over_speed"), std::string_view("fixed")};
    options.choose = static_cast<TeamPlayer::Choose>(table.choice("choose", choices));
    // What another way of choosing needs may stand there, too, for variants of a scenario.
    if (options.choose == TeamPlayer::Choose::time || table.has("time"))
        options.time = context.library.mapping(table, "time", context.from, wayToBallNames, {"time_s"});
    constexpr const char* nobody = "nobody";
    if (const std::string goes = nameOr(table, "goes", nobody); goes != nobody) {
        const auto found = std::ranges::find(options.team, goes, &TeamPlayer::Member::name);
        if (!table.failed() && found == options.team.end())
            table.reject("goes", '"' + goes + "\" is none of its team; expected one of it, or \"nobody\"");
        options.goes = found - options.team.begin() + 1;
    }
    const double seconds = table.numberOr("hysteresis_s", 0, {0, 1000});
    const double metres = table.numberOr("hysteresis_m", 0, {0, 1000});
    options.role.hysteresis = options.choose == TeamPlayer::Choose::nearest ? metres : seconds;
    const Nanoseconds agree = durationOr(table, "agree_s", options.role.agree * RoleChoice::slotLength, {0, 0.5});
    options.role.agree = (agree + RoleChoice::slotLength - 1) / RoleChoice::slotLength;
    options.handOver = durationOr(table, "hand_over_s", options.handOver, {0, 0.1});
    return {std::make_shared<TeamPlayer>(std::move(options))};
}

ControllerSetting wander(const Context& context) {
    Wander::Options options;
    TomlTable& table = context.table;
    options.speed = table.numberOr("speed_mps", options.speed, speeds);
    options.rotation = angleOr(table, "rotation_degps", options.rotation, rotations);
    options.changeEvery = table.numberOr("change_every_s", options.changeEvery, {0.01, 1e6});
    options.radius = context.driven.robot.type.shape->reach;
    options.walls = context.driven.walls;
    options.deadTime = table.numberOr("dead_time_s", context.driven.robot.deadTime, deadTimes);
    return {std::make_shared<Wander>(options)};
}

ControllerSetting dynamicWindow(const Context& context) {
    DynamicWindow::Options options;
    TomlTable& table = context.table;
    const RobotDescription& robot = context.driven.robot;
    options.sensors = obstacleSensors(robot.type);
    if (options.sensors.empty() || options.sensors[0].kind == ObstacleSensor::Kind::bumpers)
        table.reject(
            "kind",
            "the robot has no laser, no sonar and no infrared; expected a [[sensor]] of such a kind in its robot file");
    options.waypoints = points(table, "waypoints_m", 1, metresFar, false);
    options.loop = table.booleanOr("loop", options.loop);
    options.tolerance = table.numberOr("tolerance_m", options.tolerance, {0.05, 10});
    options.speed = table.numberOr("speed_mps", options.speed, {0.01, speeds.most});
    options.rotation = angleOr(table, "rotation_degps", options.rotation, {1, rotations.most});
    KinematicParameters drive;
    if (const auto* const kinematic = dynamic_cast<const KinematicModel*>(robot.model.get()))
        drive = kinematic->parameters();
    if (drive.v.limit > 0) options.speed = std::min(options.speed, drive.v.limit);
    if (drive.w.limit > 0) options.rotation = std::min(options.rotation, drive.w.limit);
    if (drive.v.acceleration > 0) options.acceleration = drive.v.acceleration;
    if (drive.w.acceleration > 0) options.turningAcceleration = drive.w.acceleration;
    options.acceleration = table.numberOr("acceleration_mps2", options.acceleration, {0.01, 100});
    options.turningAcceleration = angleOr(table, "acceleration_degps2", options.turningAcceleration, {1, 36000});
    options.margin = table.numberOr("margin_m", options.margin, {0.03, 5});
    options.lookAhead = table.numberOr("look_ahead_m", options.lookAhead, {0.2, 20});
    options.memory = durationOr(table, "memory_s", options.memory, {0, 60});
    options.headingWeight = table.numberOr("heading_weight", options.headingWeight, weights);
    options.clearanceWeight = table.numberOr("clearance_weight", options.clearanceWeight, weights);
    options.progressWeight = table.numberOr("progress_weight", options.progressWeight, weights);
    options.radius = robot.type.shape->reach;
    options.deadTime = table.numberOr("dead_time_s", robot.deadTime, deadTimes);
    return {std::make_shared<DynamicWindow>(std::move(options))};
}

constexpr const char* methodsExpected =
    "expected PLANNER+REPAIR+FIRST, as \"visibility_graph+wait+lowest\", up to 8 of them";

/// Among which methods a team chooses, and by what: a task file, whose outputs are the methods, or by nothing yet.
MethodChoice::Options methodChoice(const Context& context) {
    TomlTable& table = context.table;
    MethodChoice::Options options;
    options.listen = durationOr(table, "listen_s", options.listen, {0, 10});
    std::vector<std::string> names;
    if (table.has("choose")) {
        options.time = context.library.mapping(table, "choose", context.from);
        if (!options.time) return {};
        for (std::size_t k = 0; k < options.time->outputs(); ++k) names.emplace_back(options.time->output(k).name);
    }
    const std::string key = options.time ? "choose" : "methods";
    if (table.has("methods")) {
        const std::vector<std::string> given = table.strings("methods");
        if (options.time && given != names)
            return table.reject("methods", "are others than those that `choose` maps to"), MethodChoice::Options{};
        names = given;
    }
    if (names.size() > MethodChoice::most) table.reject(key, "names too many methods; " + std::string(methodsExpected));
    for (const std::string& name : names) {
        const std::optional<TeamMethod> method = teamMethod(name);
        if (!method) return table.reject(key, "names \"" + name + "\"; " + methodsExpected), MethodChoice::Options{};
        options.methods.push_back(*method);
    }
    for (std::size_t i = 0; options.time && i < options.time->inputs(); ++i) {
        const std::string_view name = options.time->input(i).name;
        const auto input = MethodChoice::input(name, options.methods.size());
        if (!input)
            return table.reject(key, "asks for \"" + std::string(name) + "\"; expected " + MethodChoice::inputNames()),
                   MethodChoice::Options{};
        options.inputs.push_back(*input);
    }
    return options;
}

ControllerSetting navigate(const Context& context) {
    Navigate::Options options;
    TomlTable& table = context.table;
    options.target = pose(table.table("target"));
    TeamMethod& method = options.method;
    if (table.has("planner")) method.planner = static_cast<Planner>(table.choice("planner", plannerNames));
    if (table.has("repair")) method.repair = static_cast<Repair>(table.choice("repair", repairNames));
    if (table.has("first")) method.lowestFirst = table.choice("first", {"lowest", "highest"}) == 0;
    options.choice = methodChoice(context);
    options.speed = table.numberOr("speed_mps", options.speed, {0.01, speeds.most});
    options.rotation = angleOr(table, "rotation_degps", options.rotation, {1, rotations.most});
    options.tolerance = table.numberOr("tolerance_m", options.tolerance, {0.001, 10});
    options.headingTolerance = angleOr(table, "heading_tolerance_deg", options.headingTolerance, {0.1, 360});
    options.objectRadius = table.numberOr("object_radius_m", options.objectRadius, {0.01, 10});
    options.spare = table.numberOr("spare_m", options.spare, {0.01, 5});
    options.ball = context.driven.ballRadius > 0;
    options.radius = context.driven.robot.type.shape->reach;
    options.walls = context.driven.walls;
    options.deadTime = table.numberOr("dead_time_s", context.driven.robot.deadTime, deadTimes);
    return {std::make_shared<Navigate>(std::move(options))};
}

/// The network files that a plug-in's table `mappings` names, as part of its options.
std::string mappingsText(const Context& context) {
    TomlTable& table = context.table;
    const Value* const named = table.has(mappingsKey) ? table.value(mappingsKey) : nullptr;
    TomlTable mappings = table.tableOrEmpty(mappingsKey);
    if (named == nullptr || named->asTable() == nullptr) return {};
    Value::Table texts;
    for (const auto& [key, value] : *named->asTable())
        if (const auto file =
                context.library.file(mappings, key, context.from, "nets", DescriptionLibrary::Holds::text))
            texts.emplace(key, *file->content.asText());
    return tomlText(Value::Table{{mappingsKey, std::move(texts)}});
}

/// The environment's landmarks, likewise.
std::string landmarksText(const Environment& environment) {
    Value::Array landmarks;
    for (const Landmark& landmark : landmarksOf(environment))
        landmarks.push_back(
            Value::Table{{"name", landmark.name}, {"x_m", landmark.position.x}, {"y_m", landmark.position.y}});
    return landmarks.empty() ? "" : tomlText(Value::Table{{landmarksKey, std::move(landmarks)}});
}

ControllerSetting plugin(const Context& context) {
    TomlTable& table = context.table;
    const std::string library = table.string("library");
    TomlTable options = table.tableOrEmpty("options");
    if (options.has(mappingsKey)) options.reject(mappingsKey, "stands beside the options, not among them");
    if (options.has(landmarksKey)) options.reject(landmarksKey, "are the environment's; expected another key");
    const std::string told = landmarksText(context.driven.environment) + mappingsText(context);
    if (table.failed()) return {};
    if (!context.loading.plugins) return {std::make_shared<AbsentController>()};
    auto loaded =
        context.loading.plugins(context.library.shown(joinedName(context.from, library)), options.text() + told);
    if (loaded) return {std::move(*loaded)};
    const Error& error = loaded.error();
    if (error.key.empty())
        table.reject("library", error.message());
    else if (error.key.starts_with(std::string(mappingsKey) + '.'))
        table.tableOrEmpty(mappingsKey).reject(error.key.substr(std::strlen(mappingsKey) + 1), error.cause);
    else
        options.reject(error.key, error.cause);
    return {};
}

struct Kind {
    std::string_view name;
    ControllerSetting (*read)(const Context&);
};
constexpr std::array kinds{Kind{"velocity_script", velocityScript},
                           Kind{"log_player", logPlayer},
                           Kind{"go_to_pose", goToPose},
                           Kind{"chase_ball", chaseBall},
                           Kind{"free_ball", freeBall},
                           Kind{"team_player", teamPlayer},
                           Kind{"wander", wander},
                           Kind{"dynamic_window", dynamicWindow},
                           Kind{"navigate", navigate},
                           Kind{"plugin", plugin}};

}  // namespace

ControllerSetting readController(TomlTable table, const DrivenRobot& driven, const std::string& from,
                                 DescriptionLibrary& library, const ScenarioLoading& loading) {
    std::array<std::string_view, kinds.size()> names;
    for (std::size_t i = 0; i < kinds.size(); ++i) names[i] = kinds[i].name;
    const std::size_t kind = table.choice("kind", names);
    if (table.failed()) return {};
    ControllerSetting setting = kinds[kind].read({table, driven, from, library, loading});
    table.rejectUnknown();
    return setting;
}

std::shared_ptr<const Controller> noController() {
    return std::make_shared<const CommandPlayer>(std::vector<StampedCommand>());
}

}  // namespace mrose
