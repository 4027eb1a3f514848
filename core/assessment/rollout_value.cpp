#include "assessment/rollout_value.h"

#include <algorithm>

#include "scenario/log_excerpt.h"
#include "scenario/state_scenario.h"

namespace mrose {
namespace {

/// A scenario's value on its way to that of a rollout: after the first error nothing changes any more.
class RolloutValue {
public:
    explicit RolloutValue(const ScenarioValue& value) : value_(value) {}

    /// Robots that the scenario has and the rollout does not.
    void leaveOutAllBut(const Scene& present) {
        for (const char* const kind : {"robot", "person"}) {
            const Value* const bodies = value_->content().find(kind);
            const std::size_t count = bodies && bodies->asArray() ? bodies->asArray()->size() : 0;
            for (std::size_t i = count; i > 0; --i) {
                const std::string path = kind + ('[' + std::to_string(i) + ']');
                const Value* const name = value_->at(path + ".name");
                const bool stays = std::any_of(
                    present.robots.begin(), present.robots.end(),
                    [&](const SceneRobot& robot) { return name && name->asText() && *name->asText() == robot.name; });
                if (!stays) value_ = value_->without(path);
            }
        }
        // Where others are left out the numbers stay.
        for (const SceneRobot& robot : present.robots)
            if (robot.place) set(robot.name, "number", std::int64_t{*robot.place} + 1);
    }

    void set(const std::string& body, const std::string& key, Value value) {
        if (!value_) return;
        const std::string path = value_->bodyPath(body);
        value_ = value_->with(path.empty() ? body : path + '.' + key, std::move(value));
    }
    void set(const std::string& path, Value value) {
        if (value_) value_ = value_->with(path, std::move(value));
    }

    Expected<ScenarioValue>& value() { return value_; }

private:
    Expected<ScenarioValue> value_;
};

/// The commands that a player of the world gets in a rollout that begins there.
LogExcerpt excerptAt(const LogWorld& world, std::size_t robot, const RolloutRequest& rollout) {
    LogExcerpt excerpt = world.parts().players[robot].excerpt;
    const LogSession::Part& part = world.sessions()[rollout.session].parts[robot];
    const RobotLog& real = world.log().robots[world.robots()[robot].real];
    if (real.trajectories.size() > 1 || !excerpt.trajectory.empty()) {
        const Trajectory& trajectory = real.trajectories[part.trajectory];
        excerpt.trajectory = trajectory.name;
        excerpt.start = toSeconds(part.origin + rollout.start - beginning(trajectory));
    } else {
        excerpt.start += toSeconds(rollout.start);
    }
    return excerpt;
}

Value playedFrom(const RolloutStart& start, Nanoseconds duration, const std::string& log) {
    ExcerptContent content{commandsRead(start, start.time + duration), start.pose};
    for (StampedCommand& command : content.commands) command.time -= start.time;
    return std::make_shared<const DescriptionFile>(DescriptionFile{log, log, excerptValue(content)});
}

}  // namespace

Expected<OpenedRollout> openRollout(const LogWorld& world, const ScenarioValue& value, const std::string& log,
                                    const RolloutRequest& rollout, std::uint64_t seed, Nanoseconds length,
                                    Nanoseconds duration) {
    LogWorld::OpenedParts opened = world.partsAt(rollout.session, rollout.start, duration);
    if (std::none_of(opened.starts.begin(), opened.starts.end(), [](const auto& start) { return start.has_value(); }))
        return fail(log, "has no ground truth of any robot there; expected another start");
    opened.parts.seed = seed;
    opened.parts.duration = length;
    OpenedRollout result;
    result.scenario = std::make_shared<const Scenario>(std::move(opened.parts));
    result.state = result.scenario->initialState();
    RolloutValue described(value);
    described.leaveOutAllBut(result.scenario->scene());
    for (std::size_t robot = 0; robot < world.robots().size(); ++robot) {
        if (!opened.starts[robot]) continue;
        const std::string& name = world.robots()[robot].name;
        const LogExcerpt excerpt = excerptAt(world, robot, rollout);
        described.set(name, "controller.log", playedFrom(*opened.starts[robot], duration, log));
        described.set(name, "controller.start_s", excerpt.start);
        if (!excerpt.trajectory.empty()) described.set(name, "controller.trajectory", excerpt.trajectory);
    }
    described.set("duration_s", toSeconds(length));
    if (!described.value()) return tl::unexpected(described.value().error());
    auto begun = withState(*described.value(), *result.scenario, result.state);
    if (!begun) return tl::unexpected(begun.error());
    result.value = std::make_shared<const ScenarioValue>(std::move(*begun));
    return result;
}

}  // namespace mrose
