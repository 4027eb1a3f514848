#include "comparison/course_descriptions.h"

#include <algorithm>

#include "io/number_text.h"
#include "io/toml_edit.h"
#include "logs/csv_writer.h"
#include "scenario/description_edit.h"
#include "scenario/log_excerpt.h"
#include "scenario/saved_state.h"
#include "scenario/scenario_file.h"

namespace mrose {
namespace {

constexpr const char* stateName = "course.state";

/// What a player of the world is told in a course that begins there.
LogExcerpt excerptOf(const LogWorld& world, std::size_t robot, const std::string& log, std::size_t take,
                     Nanoseconds start) {
    LogExcerpt excerpt = world.parts().players[robot].excerpt;
    const Take::Part& part = world.takes()[take].parts[robot];
    excerpt.log = excerpt.reference = log;
    const RobotLog& real = world.log().robots[world.robots()[robot].real];
    if (real.trajectories.size() > 1 || !excerpt.trajectory.empty()) {
        const Trajectory& trajectory = real.trajectories[part.trajectory];
        excerpt.trajectory = trajectory.name;
        excerpt.start = toSeconds(part.origin + start - beginning(trajectory));
    } else {
        excerpt.start += toSeconds(start);
    }
    return excerpt;
}

/// As excerpts of logs are kept: the commands, and the pose at the start.
std::string courseText(const LogWorld& world, const RolloutStart& start, std::size_t robot, Nanoseconds duration) {
    Trajectory part{.name = start.trajectory->name};
    part.commands = commandsRead(start, start.time + duration);
    // A log has two rows at least.
    if (part.commands.size() == 1) part.commands.push_back({start.time + duration, part.commands.front().command});
    part.poses = {{start.time, start.pose}};
    Log text;
    text.synthetic = world.log().synthetic;
    text.robots.push_back({world.robots()[robot].realName, {std::move(part)}, {}});
    return toCsv(text);
}

Expected<std::string> tableOf(const Descriptions& descriptions, const std::string& body) {
    auto table =
        tomlTableNamed(descriptions.texts.at(descriptions.scenario), descriptions.scenario, {"robot", "person"}, body);
    if (table && table->empty()) return fail(descriptions.scenario, "has no robot \"" + body + '"');
    return table;
}

/// Robots that the scenario's file has and the course does not.
Expected<void> leaveOutAbsent(Descriptions& descriptions, const Scene& present) {
    std::string& text = descriptions.texts.at(descriptions.scenario);
    for (const char* const kind : {"robot[].name", "person[].name"}) {
        const auto names = tomlStrings(text, descriptions.scenario, kind);
        if (!names) return tl::unexpected(names.error());
        for (auto name = names->rbegin(); name != names->rend(); ++name) {
            if (std::any_of(present.robots.begin(), present.robots.end(),
                            [&](const SceneRobot& robot) { return robot.name == name->value; }))
                continue;
            auto edited = withoutTomlTable(text, descriptions.scenario, name->place.table);
            if (!edited) return tl::unexpected(edited.error());
            text = std::move(*edited);
        }
    }
    return {};
}

Expected<void> tellFrom(Descriptions& descriptions, const std::string& body, const LogExcerpt& excerpt) {
    const auto table = tableOf(descriptions, body);
    if (!table) return tl::unexpected(table.error());
    const std::string controller = *table + ".controller";
    std::vector<TomlEdit> edits{{{controller, "log"}, tomlString(excerpt.reference)},
                                {{controller, "start_s", "robot"}, numberText(excerpt.start)}};
    if (!excerpt.trajectory.empty())
        edits.push_back({{controller, "trajectory", "robot"}, tomlString(excerpt.trajectory)});
    std::string& text = descriptions.texts.at(descriptions.scenario);
    auto edited = withTomlValues(text, descriptions.scenario, edits);
    if (!edited) return tl::unexpected(edited.error());
    text = std::move(*edited);
    return {};
}

Expected<void> beginWith(Descriptions& descriptions, const Scenario& scenario, const WorldState& state,
                         Nanoseconds length) {
    auto seeded = withSeed(descriptions, state.seed);
    if (!seeded) return tl::unexpected(seeded.error());
    descriptions = std::move(*seeded);
    std::string& text = descriptions.texts.at(descriptions.scenario);
    const TomlEdit edits[] = {{{"", "initial_state", "environment"}, tomlString(stateName)},
                              {{"", "duration_s", "seed"}, numberText(toSeconds(length))}};
    auto edited = withTomlValues(text, descriptions.scenario, edits);
    if (!edited) return tl::unexpected(edited.error());
    text = std::move(*edited);
    descriptions.texts[joinedName(descriptions.scenario, stateName)] = savedStateText(savedState(scenario, state));
    return {};
}

/// Where others are left out the numbers stay.
Expected<void> keepNumbers(Descriptions& descriptions, const Scene& present) {
    std::vector<TomlEdit> edits;
    for (const SceneRobot& robot : present.robots) {
        if (!robot.place) continue;
        const auto table = tableOf(descriptions, robot.name);
        if (!table) return tl::unexpected(table.error());
        edits.push_back({{*table, "number", "name"}, std::to_string(*robot.place + 1)});
    }
    std::string& text = descriptions.texts.at(descriptions.scenario);
    auto edited = withTomlValues(text, descriptions.scenario, edits);
    if (!edited) return tl::unexpected(edited.error());
    text = std::move(*edited);
    return {};
}

}  // namespace

Expected<DescribedCourse> describeCourse(const LogWorld& world, const LogWorld::Opened& opened,
                                         const Descriptions& descriptions, const std::string& log,
                                         const CourseRequest& request, Nanoseconds length, Nanoseconds duration) {
    DescribedCourse course{descriptions, nullptr, {}};
    if (auto left = leaveOutAbsent(course.descriptions, opened.scenario->scene()); !left)
        return tl::unexpected(left.error());
    if (auto kept = keepNumbers(course.descriptions, opened.scenario->scene()); !kept)
        return tl::unexpected(kept.error());
    for (std::size_t robot = 0; robot < world.robots().size(); ++robot) {
        if (!opened.starts[robot]) continue;
        const LogExcerpt excerpt = excerptOf(world, robot, log, request.take, request.start);
        if (auto told = tellFrom(course.descriptions, world.robots()[robot].name, excerpt); !told)
            return tl::unexpected(told.error());
        course.descriptions.texts[excerpt.name()] = courseText(world, *opened.starts[robot], robot, duration);
    }
    if (auto begun = beginWith(course.descriptions, *opened.scenario, opened.state, length); !begun)
        return tl::unexpected(begun.error());
    KeptDescriptions source(course.descriptions.texts);
    auto loaded = loadScenario(course.descriptions.scenario, source);
    if (!loaded) return tl::unexpected(loaded.error());
    // Plug-ins are not loaded twice, and processes of theirs are shared by all courses.
    for (std::size_t i = 0; i < loaded->parts.controllers.size(); ++i)
        if (std::none_of(loaded->parts.players.begin(), loaded->parts.players.end(),
                         [&](const LogPlayer& player) { return player.robot == i; }))
            loaded->parts.controllers[i] = opened.scenario->parts().controllers[i];
    course.scenario = std::make_shared<const Scenario>(std::move(loaded->parts));
    course.state = opened.state;
    return course;
}

}  // namespace mrose
