#include "debug/edit.h"

#include <cmath>

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
            robot.segment.direction = {std::cos(robot.segment.start.heading), std::sin(robot.segment.start.heading)};
        } else {
            ObjectState& object = state.objects[body - state.robots.size()];
            object.pose = pose;
            object.velocity_W = {};
            object.roll_W = {};
        }
    };
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
