#include "scenario/saved_state.h"

#include <algorithm>

#include "io/base64.h"
#include "io/toml_table.h"
#include "io/toml_text.h"
#include "scenario/carry_over.h"
#include "scenario/value_file.h"
#include "world/first_state_version.h"
#include "world/seconds_text.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

/// The sensors that every robot had, and all that there were.
std::vector<SavedState::Robot::Sensor> firstVersionSensors() {
    return {{std::string(selfReading), firstVersionSelf}, {"sight", firstVersionSight}};
}

constexpr std::int64_t mostOfAnything = std::int64_t{1} << 32, mostTicks = std::int64_t{1} << 48;

/// How the arrays differ from what the entries of robots and objects say; "" where they do not.
std::string wrongLayout(const SavedState& saved) {
    const WorldState& state = saved.state;
    std::uint64_t commands = 0, motion = 0, memory = 0, sensing = 0;
    for (const SavedState::Robot& robot : saved.robots) {
        commands += robot.commands;
        motion += paddedMemory(robot.motion);
        memory += paddedMemory(robot.memory);
        for (const SavedState::Robot::Sensor& sensor : robot.sensors) sensing += paddedMemory(sensor.memory);
    }
    for (const SavedState::Object& object : saved.objects) motion += paddedMemory(object.motion);
    const std::size_t bodies = saved.robots.size() + saved.objects.size();
    if (state.robots.size() != saved.robots.size() || state.objects.size() != saved.objects.size() ||
        state.commands.size() != commands || state.motion.size() != motion || state.memory.size() != memory ||
        state.sensing.size() != sensing || (bodies == 0 ? !state.past.empty() : state.past.size() % bodies != 0))
        return "holds other bodies, commands or memory than are listed beside it";
    for (std::size_t i = 0; i < saved.robots.size(); ++i)
        if (state.robots[i].commandCount > saved.robots[i].commands || state.robots[i].nextControl < state.tick)
            return "is broken in robot \"" + saved.robots[i].name + '"';
    if (state.tick < 0 || state.tick > mostTicks || state.tick > latestTime / saved.tickLength) return "is of no tick";
    return {};
}

/// A body that is put elsewhere takes its way and its past along.
void moveRobot(RobotState& robot, const Pose& to) {
    const Pose segment = relative(robot.pose, robot.segment.start);
    robot.pose = to;
    robot.segment.start = to * segment;
    robot.segment.direction = Placement(robot.segment.start).rotate({1, 0});
}

void movePast(WorldState& state, std::size_t body, const Pose& from, const Pose& to) {
    const std::size_t bodies = state.robots.size() + state.objects.size();
    for (std::size_t i = body; i < state.past.size(); i += bodies) state.past[i] = to * relative(from, state.past[i]);
}

void moveToStarts(const Scene& scene, WorldState& state) {
    for (std::size_t body = 0; body < scene.bodyCount(); ++body) {
        const bool robot = body < state.robots.size();
        const std::size_t object = body - state.robots.size();
        const Pose from = Scenario::poseOf(state, body),
                   to = robot ? scene.robots[body].start : scene.objects[object].start;
        if (identical(from.x, to.x) && identical(from.y, to.y) && identical(from.heading, to.heading)) continue;
        if (robot)
            moveRobot(state.robots[body], to);
        else
            state.objects[object].pose = to;
        movePast(state, body, from, to);
    }
}

/// Of the ticks before, as many as sensors of the scenario may ask for.
void layOutPast(const SavedState& saved, const Scenario& scenario, WorldState& state) {
    const std::size_t bodies = scenario.scene().bodyCount();
    if (bodies == 0) return;
    const auto kept = static_cast<std::int64_t>(saved.state.past.size() / bodies);
    const std::int64_t depth = scenario.pastDepth();
    state.past.resize(static_cast<std::size_t>(depth) * bodies);
    const auto slot = [&](std::int64_t lag, std::int64_t of) {
        return static_cast<std::size_t>(((state.tick - lag) % of + of) % of) * bodies;
    };
    for (std::int64_t lag = 1; lag <= depth; ++lag)
        for (std::size_t body = 0; body < bodies; ++body)
            state.past[slot(lag, depth) + body] = kept == 0 ? Scenario::poseOf(saved.state, body)
                                                            : saved.state.past[slot(std::min(lag, kept), kept) + body];
}

}  // namespace

SavedState savedState(const Scenario& scenario, const WorldState& state) {
    const Scene& scene = scenario.scene();
    SavedState saved{scenario.parts().name, scene.tickLength, {}, {}, state};
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
        saved.robots.push_back({scene.robots[i].name,
                                scene.modelOf(i).period(),
                                scenario.commandSlots(state, i).size(),
                                scenario.motionMemory(state, i).size(),
                                scenario.memoryOf(state, i).size(),
                                {}});
        for (const auto& sensor : scenario.sensors(i))
            saved.robots.back().sensors.push_back({sensor->name(), sensor->memorySize()});
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        saved.objects.push_back({scene.objects[i].name, scenario.motionMemory(state, scene.robots.size() + i).size()});
    return saved;
}

std::string savedStateText(const SavedState& saved, const ScenarioValue* whole) {
    const auto number = [](const char* key, std::uint64_t value) {
        return std::string(key) + " = " + std::to_string(value) + '\n';
    };
    std::string text =
        "# The state of a run of \"" + saved.scenario + "\" at " + plainSeconds(saved.state.tick * saved.tickLength) +
        " s, for a scenario's `initial_state`.\nformat = \"mrose state\"\nversion = 2\nscenario = " +
        tomlString(saved.scenario) + '\n' + number("tick", static_cast<std::uint64_t>(saved.state.tick)) +
        number("tick_ns", static_cast<std::uint64_t>(saved.tickLength)) + "state = \"\"\"\n" +
        base64(stateBytes(saved.state)) + "\"\"\"\n";
    if (whole) text += "value = \"\"\"\n" + encoded(*whole) + "\"\"\"\n";
    for (const SavedState::Robot& robot : saved.robots) {
        text += "\n[[robot]]\nname = " + tomlString(robot.name) + '\n' +
                number("period_ns", static_cast<std::uint64_t>(robot.period)) + number("commands", robot.commands) +
                number("motion", robot.motion) + number("memory", robot.memory);
        for (const SavedState::Robot::Sensor& sensor : robot.sensors)
            text += "[[robot.sensor]]\nname = " + tomlString(sensor.name) + '\n' + number("memory", sensor.memory);
    }
    for (const SavedState::Object& object : saved.objects)
        text += "\n[[object]]\nname = " + tomlString(object.name) + '\n' +
                (object.motion != 0 ? number("motion", object.motion) : "");
    return text;
}

Expected<SavedState> parseSavedState(std::string_view text, const std::string& file) {
    const auto content = parseToml(text, file);
    return content ? readSavedState(*content, file) : tl::unexpected(content.error());
}

Expected<SavedState> readSavedState(const Value& content, const std::string& file) {
    TomlTable root = TomlTable::of(content, file);
    root.choice("format", {"mrose state"});
    const bool first = root.integer("version", 1, 2) == 1;
    SavedState saved;
    saved.scenario = root.string("scenario");
    const std::int64_t tick = root.integer("tick", 0, mostTicks);
    saved.tickLength = root.integer("tick_ns", 1, mostOfAnything);
    const std::string letters = root.string("state");
    root.stringOr("value", "");  // of who runs the file by itself (value_file.h)
    for (TomlTable& table : root.tablesOrNone("robot")) {
        const std::string name = table.string("name");
        const Nanoseconds period = table.integer("period_ns", 1, mostOfAnything * 10);
        const auto commands = static_cast<std::uint64_t>(table.integer("commands", 0, mostOfAnything));
        const auto bytes = [](TomlTable& of, const char* key) {
            return static_cast<std::uint64_t>(of.integer(key, 0, mostOfAnything));
        };
        const std::uint64_t memory = bytes(table, "memory");
        saved.robots.push_back({name, period, commands, first ? firstVersionMotion : bytes(table, "motion"), memory,
                                first ? firstVersionSensors() : std::vector<SavedState::Robot::Sensor>()});
        for (TomlTable& sensor : table.tablesOrNone("sensor")) {
            const std::string sensorName = sensor.string("name");
            saved.robots.back().sensors.push_back({sensorName, bytes(sensor, "memory")});
            sensor.rejectUnknown();
        }
        table.rejectUnknown();
    }
    for (TomlTable& table : root.tablesOrNone("object")) {
        const std::string name = table.string("name");
        saved.objects.push_back({name, static_cast<std::uint64_t>(table.integerOr("motion", 0, 0, mostOfAnything))});
        table.rejectUnknown();
    }
    root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    const auto bytes = fromBase64(letters);
    if (!bytes) root.reject("state", "is damaged: it is not base64");
    auto state = bytes ? parseState(*bytes, file) : Expected<WorldState>(WorldState());
    if (!state) root.reject("state", "is damaged: it " + state.error().cause);
    if (root.failed()) return tl::unexpected(root.error());
    saved.state = std::move(*state);
    if (const std::string wrong = wrongLayout(saved); !wrong.empty()) root.reject("state", wrong);
    if (saved.state.tick != tick) root.reject("tick", "is not the state's, " + std::to_string(saved.state.tick));
    if (root.failed()) return tl::unexpected(root.error());
    return saved;
}

std::string unfit(const SavedState& saved, const Scene& scene) {
    const std::string of = "is a state of \"" + saved.scenario + "\" with ";
    const auto others = [&](const char* what, const auto& kept, const auto& own) -> std::string {
        if (kept.size() != own.size())
            return of + std::to_string(kept.size()) + ' ' + what + "s; the scenario has " + std::to_string(own.size());
        for (std::size_t i = 0; i < kept.size(); ++i)
            if (kept[i].name != own[i].name)
                return of + "the " + what + " \"" + kept[i].name + "\" where the scenario has \"" + own[i].name + '"';
        return "";
    };
    if (std::string wrong = others("robot", saved.robots, scene.robots); !wrong.empty()) return wrong;
    if (std::string wrong = others("object", saved.objects, scene.objects); !wrong.empty()) return wrong;
    if (saved.tickLength != scene.tickLength)
        return of + "ticks of " + plainSeconds(saved.tickLength) + " s; the scenario's are " +
               plainSeconds(scene.tickLength) + " s";
    if (saved.state.goals.size() != scene.environment.goals.size())
        return of + std::to_string(saved.state.goals.size()) + " goals; the scenario has " +
               std::to_string(scene.environment.goals.size());
    return "";
}

namespace {

void keep(std::span<const std::byte> all, std::size_t& first, std::uint64_t size, std::span<std::byte> own) {
    if (own.size() == size) std::copy_n(all.data() + first, size, own.begin());
    first += paddedMemory(size);
}

void keepSensors(std::span<const std::byte> all, std::size_t& first, const std::vector<SavedState::Robot::Sensor>& kept,
                 const Scenario& scenario, std::size_t robot, WorldState& state) {
    const auto sensors = scenario.sensors(robot);
    for (const SavedState::Robot::Sensor& one : kept) {
        const auto found =
            std::ranges::find_if(sensors, [&](const auto& sensor) { return sensor->name() == one.name; });
        const auto place = static_cast<std::size_t>(found - sensors.begin());
        keep(all, first, one.memory,
             found == sensors.end() ? std::span<std::byte>() : scenario.sensorMemory(state, robot, place));
    }
}

}  // namespace

WorldState restored(const SavedState& saved, const Scenario& scenario, std::uint64_t seed) {
    WorldState state = saved.state, fresh = scenario.freshState(seed);
    state.seed = seed;
    state.commands = std::move(fresh.commands);
    state.motion = std::move(fresh.motion);
    state.memory = std::move(fresh.memory);
    state.sensing = std::move(fresh.sensing);
    std::size_t commands = 0, motion = 0, memory = 0, sensing = 0;
    for (std::size_t i = 0; i < saved.robots.size(); ++i) {
        const SavedState::Robot& kept = saved.robots[i];
        RobotState& robot = state.robots[i];
        const std::span<const StampedCommand> old(saved.state.commands.data() + commands, robot.commandCount);
        robot.commandCount = keepNewest(old, scenario.commandSlots(state, i), robot.commandBefore);
        keep(saved.state.motion, motion, kept.motion, scenario.motionMemory(state, i));
        keep(saved.state.memory, memory, kept.memory, scenario.memoryOf(state, i));
        keepSensors(saved.state.sensing, sensing, kept.sensors, scenario, i, state);
        if (kept.period != scenario.scene().modelOf(i).period())
            robot.nextControl = robot.segment.startTick = state.tick;
        commands += kept.commands;
    }
    for (std::size_t i = 0; i < saved.objects.size(); ++i)
        keep(saved.state.motion, motion, saved.objects[i].motion,
             scenario.motionMemory(state, saved.robots.size() + i));
    std::erase_if(state.touches, [&](const RobotTouch& touch) {
        return touch.robot < state.robots.size() && !scenario.feelsTouches(touch.robot);
    });
    layOutPast(saved, scenario, state);
    moveToStarts(scenario.scene(), state);
    return state;
}

}  // namespace mrose
