#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "simulation/step_stages.h"
#include "world/absurd_command.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

bool plausible(const MotionStep& step, double period) {
    const auto& [increment, velocity] = step;
    return !isAbsurd(increment.x / period) && !isAbsurd(increment.y / period) &&
           !isAbsurd(increment.heading / period) && !isAbsurd(velocity.v) && !isAbsurd(velocity.w);
}

/// What is wrong with one that is not plausible.
std::string motionProblem(const MotionStep& step, double period) {
    const auto& [increment, velocity] = step;
    if (!std::isfinite(increment.x + increment.y + increment.heading) || !std::isfinite(velocity.v + velocity.w))
        return "its motion model predicted no finite motion";
    std::string absurd;
    for (const double speed : {increment.x / period, increment.y / period, velocity.v})
        if (absurd.empty()) absurd = absurdity(speed, " m/s");
    for (const double rate : {increment.heading / period, velocity.w})
        if (absurd.empty()) absurd = absurdity(rate, " rad/s");
    return "its motion model predicted " + absurd;
}

}  // namespace

void predictMotion(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, StepTrace* trace) {
    const Scene& scene = scenario.scene();
    std::vector<std::uint32_t>& due = buffers.due;
    const auto modelOf = [&](std::uint32_t robot) { return scene.robots[robot].model; };
    // Robots of one model are predicted together.
    if (scene.models.size() > 1)
        std::sort(due.begin(), due.end(), [&](std::uint32_t a, std::uint32_t b) {
            return modelOf(a) != modelOf(b) ? modelOf(a) < modelOf(b) : a < b;
        });
    buffers.inputs.clear();
    buffers.predictions.resize(due.size());
    for (const std::uint32_t i : due) {
        const RobotState& robot = state.robots[i];
        MotionInput& input = buffers.inputs.emplace_back();
        input.commands = scenario.commandsOf(state, i);
        input.start = scene.timeOf(state.tick);
        input.velocity = {robot.velocity_B.x, robot.velocity_B.rotation};
        input.memory = scenario.motionMemory(state, i);
        input.noise = NoiseKey{state.seed, state.tick, i, channelOf(NoiseChannel::motion)};
    }
    for (std::size_t begin = 0, end = 0; begin < due.size(); begin = end) {
        while (end < due.size() && modelOf(due[end]) == modelOf(due[begin])) ++end;
        scene.models[modelOf(due[begin])]->predict(std::span(buffers.inputs).subspan(begin, end - begin),
                                                   std::span(buffers.predictions).subspan(begin, end - begin));
    }
    for (std::size_t k = 0; k < due.size(); ++k) {
        const std::uint32_t i = due[k];
        RobotState& robot = state.robots[i];
        MotionStep& predicted = buffers.predictions[k];
        const double period = scenario.periodOf(i).seconds;
        if (plausible(predicted, period)) {
            robot.segment = beginSegment(robot.pose, robot.velocity_B, predicted, state.tick, period);
        } else {
            if (trace != nullptr) trace->faults.push_back({i, motionProblem(predicted, period)});
            robot.segment = restAt(robot.pose, state.tick);
            predicted = {};
            scenario.forgetMotion(state, i);
        }
        if (trace != nullptr) trace->robots[i].predicted = predicted;
    }
}

}  // namespace mrose
