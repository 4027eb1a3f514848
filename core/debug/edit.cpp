#include "debug/edit.h"

#include "debug/placement.h"
#include "geometry/point.h"
#include "io/format.h"
#include "scenario/carry_over.h"

namespace mrose {

Edit moveBody(const FieldFrame& frame, std::size_t body, const Pose& pose) {
    const Pose& before = frame.poseOf(body);
    const bool turned = before.x == pose.x && before.y == pose.y;
    Edit edit{frame.nameOf(body) + (turned ? " turned" : " moved")};
    edit.change = [body, pose](const Scenario&, WorldState& state) {
        if (body < state.robots.size()) {
            RobotState& robot = state.robots[body];
            const Pose shift = pose * inverse(robot.pose);
            robot.pose = pose;
            robot.segment.start = shift * robot.segment.start;
            robot.segment.direction = towards(robot.segment.start.heading);
        } else {
            ObjectState& object = state.objects[body - state.robots.size()];
            object.pose = pose;
            object.velocity_W = {};
            object.roll_W = {};
        }
    };
    return edit;
}

Expected<Edit> putBody(const FieldFrame& frame, std::size_t body, const Pose& pose) {
    const std::string why = hindranceAt(frame, body, pose);
    const std::string& name = frame.nameOf(body);
    const auto place = freePlaceNear(frame, body, pose);
    if (!place)
        return fail("", name + " stays where it was: there it would stand " + why + ", and no place near it is free");
    Edit edit = moveBody(frame, body, *place);
    const double aside = distance(position(*place), position(pose));
    if (!why.empty())
        edit.note =
            name + " stands " + fixed(100 * aside, 0) + " cm beside: where it was put it would have stood " + why;
    return edit;
}

Command decidedCommand(const FieldFrame& frame, std::size_t robot) {
    const RobotInsight& insight = frame.insights[robot];
    if (insight.decision.command) return *insight.decision.command;
    return frame.scenario->commandsOf(frame.state, robot).at(frame.now());
}

Edit changeDecision(const FieldFrame& frame, std::size_t robot, const OtherDecision& other) {
    const RobotInsight& decided = frame.insights[robot];
    HandOrder order;
    order.robot = static_cast<std::uint32_t>(robot);
    order.first = decided.tick;
    order.end = decided.tick + other.periods * frame.scene().periodTicks(robot);
    order.command = other.command;
    order.kicks = other.kicks;
    const Command before = decidedCommand(frame, robot);
    std::string changed;
    const auto add = [&](const std::string& what) { changed += (changed.empty() ? "" : ", ") + what; };
    if (other.command.v != before.v) add(fixed(other.command.v, 2) + " m/s");
    if (other.command.w != before.w) add(fixed(other.command.w, 2) + " rad/s");
    if (other.kicks != decided.decision.kicks)
        add(other.kicks.empty() ? "no kick" : "kick " + fixed(100 * other.kicks.front().power, 0) + " %");
    Edit edit{frame.nameOf(robot) + ": " + (changed.empty() ? "as decided" : changed)};
    edit.tick = decided.tick;
    edit.orders = {order};
    edit.afterDeciding = order.robot;
    return edit;
}

Edit changeNoise() {
    Edit edit{"other noise"};
    edit.change = [](const Scenario&, WorldState& state) { ++state.seed; };
    return edit;
}

Edit restartWithSeed(const BranchSetupPointer& setup, std::uint64_t seed) {
    Edit edit{"seed " + std::to_string(seed)};
    edit.setup = setup;
    edit.start = setup->scenario->initialState(seed);
    return edit;
}

Edit changeSetup(const std::string& name, const BranchSetupPointer& from, BranchSetupPointer to) {
    Edit edit{name};
    edit.setup = std::move(to);
    edit.change = [from](const Scenario& scenario, WorldState& state) {
        state = carriedOver(*from->scenario, state, scenario);
    };
    return edit;
}

}  // namespace mrose
