#include <algorithm>
#include <cmath>

#include "simulation/observe.h"
#include "simulation/step_stages.h"

namespace mrose {
namespace {

void addFault(StepTrace* trace, std::size_t robot, std::string what) {
    if (trace != nullptr) trace->faults.push_back({static_cast<std::uint32_t>(robot), std::move(what)});
}

bool finite(const Command& command) { return std::isfinite(command.v) && std::isfinite(command.w); }

/// What is wrong with orders; nullptr: nothing.
const char* objection(const Decision& decision, Nanoseconds now, std::size_t manipulators) {
    if (decision.command && !finite(*decision.command)) return "its controller gave a command that is not finite";
    Nanoseconds last = std::numeric_limits<Nanoseconds>::min();
    for (const StampedCommand& earlier : decision.earlier) {
        if (!finite(earlier.command)) return "its controller gave a command that is not finite";
        if (earlier.time < last || earlier.time > now)
            return "its controller gave commands out of order or of the future";
        last = earlier.time;
    }
    for (const Kick& kick : decision.kicks) {
        if (!(kick.power >= 0 && kick.power <= 1)) return "its controller gave a kick whose power is not in 0 ... 1";
        if (kick.manipulator >= manipulators) return "its controller kicked with a manipulator that it does not have";
    }
    for (const RadioMessage& message : decision.messages)
        if (message.size > RadioMessage::most) return "its controller sent a message that is too large";
    return nullptr;
}

void issue(const Scenario& scenario, WorldState& state, std::size_t robot, const StampedCommand& command) {
    RobotState& r = state.robots[robot];
    std::size_t count = r.commandCount;
    const std::span<StampedCommand> slots = scenario.commandSlots(state, robot);
    if (count > 0 && command.time < slots[count - 1].time) return;  // a player's log that begins before the run
    issueCommand(slots, count, r.commandBefore, command);
    r.commandCount = static_cast<std::uint32_t>(count);
}

void obey(const Scenario& scenario, WorldState& state, std::size_t robot, const Decision& decision, StepTrace* trace) {
    const Nanoseconds now = scenario.scene().timeOf(state.tick);
    const std::vector<Manipulator>& manipulators = scenario.scene().typeOf(robot).manipulators;
    const char* const wrong = objection(decision, now, manipulators.size());
    if (wrong != nullptr || !decision.fault.empty()) {
        addFault(trace, robot, wrong != nullptr ? wrong : decision.fault);
        issue(scenario, state, robot, {now, {}});
        return;
    }
    for (const StampedCommand& earlier : decision.earlier) issue(scenario, state, robot, earlier);
    if (decision.command) issue(scenario, state, robot, {now, *decision.command});
    for (const Kick& kick : decision.kicks)
        state.kicks.push_back({now + manipulators[kick.manipulator].deadTime, static_cast<std::uint32_t>(robot),
                               kick.manipulator, kick.power});
    for (const RadioMessage& message : decision.messages)
        state.messages.push_back(
            {state.tick, static_cast<std::uint32_t>(robot), message.to, message.kind, message.size, message.bytes});
}

const Decision* overriding(const Overrides& overrides, std::uint32_t robot) {
    const auto found = std::lower_bound(overrides.decisions.begin(), overrides.decisions.end(), robot,
                                        [](const RobotDecision& d, std::uint32_t r) { return d.robot < r; });
    return found != overrides.decisions.end() && found->robot == robot ? &found->decision : nullptr;
}

}  // namespace

void decide(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, const Overrides& overrides,
            StepTrace* trace) {
    std::erase_if(state.messages, [&](const SentMessage& m) { return m.tick < state.tick - scenario.longestPeriod(); });
    buffers.due.clear();
    buffers.sensing.forget();
    for (std::uint32_t i = 0; i < state.robots.size(); ++i) {
        RobotState& robot = state.robots[i];
        if (robot.nextControl != state.tick) continue;
        robot.nextControl += scenario.periodOf(i).ticks;
        buffers.due.push_back(i);
        const Decision* decision = overriding(overrides, i);
        if (decision == nullptr && overrides.askControllers) {
            observe(scenario, state, i, scenario.sensorMemory(state, i), buffers.sensing, buffers.observation);
            buffers.decision.clear();
            scenario.controller(i).decide(buffers.observation, scenario.memoryOf(state, i), buffers.decision);
            decision = &buffers.decision;
        }
        if (decision != nullptr) obey(scenario, state, i, *decision, trace);
        if (trace == nullptr) continue;
        StepTrace::Robot& traced = trace->robots[i];
        traced.decided = decision != nullptr;
        traced.observed = decision == &buffers.decision;
        if (traced.observed) traced.observation = buffers.observation;
        if (decision != nullptr) traced.decision = *decision;
    }
}

void rememberPoses(const Scenario& scenario, WorldState& state) {
    if (scenario.pastDepth() == 0) return;
    const std::span<Pose> now = scenario.past().posesOfNow(state);
    for (std::size_t body = 0; body < now.size(); ++body) now[body] = poseOf(state, body);
}

}  // namespace mrose
