#include <algorithm>
#include <limits>

#include "simulation/observe.h"
#include "simulation/step_stages.h"
#include "world/absurd_command.h"

namespace mrose {
namespace {

void addFault(StepTrace* trace, std::size_t robot, std::string what) {
    if (trace != nullptr) trace->faults.push_back({static_cast<std::uint32_t>(robot), std::move(what)});
}

/// What is wrong with messages; empty: nothing.
std::string messageObjection(const Decision& decision, const Scene& scene) {
    if (decision.messages.size() > mostMessages) return "its controller sent more than 64 messages at once";
    for (const RadioMessage& message : decision.messages) {
        if (message.size > scene.radio.messageBytes)
            return "its controller sent a message of " + std::to_string(message.size) + " bytes; the radio carries " +
                   std::to_string(scene.radio.messageBytes);
        if (message.to != broadcast && message.to >= scene.robots.size())
            return "its controller sent a message to a robot that is not there";
    }
    return {};
}

/// What is wrong with orders; empty: nothing.
std::string objection(const Decision& decision, Nanoseconds now, std::size_t robot, const Scene& scene) {
    const std::size_t manipulators = scene.typeOf(robot).manipulators.size();
    if (decision.command && isAbsurd(*decision.command)) return "its controller " + absurdity(*decision.command);
    Nanoseconds last = std::numeric_limits<Nanoseconds>::min();
    for (const StampedCommand& earlier : decision.earlier) {
        if (isAbsurd(earlier.command)) return "its controller " + absurdity(earlier.command);
        if (earlier.time < last || earlier.time > now)
            return "its controller gave commands out of order or of the future";
        last = earlier.time;
    }
    for (const Kick& kick : decision.kicks) {
        if (!(kick.power >= 0 && kick.power <= 1)) return "its controller gave a kick whose power is not in 0 ... 1";
        if (kick.manipulator >= manipulators) return "its controller kicked with a manipulator that it does not have";
    }
    return messageObjection(decision, scene);
}

/// Messages that cannot be sent become a fault, and the others are what they say they are: nothing else is recorded.
void checkMessages(Decision& decision, const Scene& scene) {
    if (decision.messages.empty()) return;
    if (std::string wrong = messageObjection(decision, scene); !wrong.empty()) {
        decision.messages.clear();
        if (decision.fault.empty()) decision.fault = std::move(wrong);
    }
    for (RadioMessage& message : decision.messages)
        std::fill(message.bytes.begin() + message.size, message.bytes.end(), std::byte{0});
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
    const Scene& scene = scenario.scene();
    const Nanoseconds now = scene.timeOf(state.tick);
    const std::string wrong = objection(decision, now, robot, scene);
    if (!wrong.empty() || !decision.fault.empty()) {
        addFault(trace, robot, wrong.empty() ? decision.fault : wrong);
        issue(scenario, state, robot, {now, {}});
        return;
    }
    for (const StampedCommand& earlier : decision.earlier) issue(scenario, state, robot, earlier);
    if (decision.command) issue(scenario, state, robot, {now, *decision.command});
    const auto index = static_cast<std::uint32_t>(robot);
    for (const Kick& kick : decision.kicks) {
        state.kicks.push_back({kickDue(scene, state, index, kick), index, kick.manipulator, kick.power});
        if (trace != nullptr) trace->orderedKicks.push_back(state.kicks.back());
    }
    std::uint64_t number = 0;
    for (const RadioMessage& message : decision.messages)
        state.messages.push_back({state.tick, number++, static_cast<std::uint32_t>(robot), message.to, message.kind,
                                  message.size, position(state.robots[robot].pose), scene.radio.latency,
                                  scene.radio.jitter, message.bytes});
}

const Decision* overriding(const Overrides& overrides, std::uint32_t robot) {
    const auto found = std::lower_bound(overrides.decisions.begin(), overrides.decisions.end(), robot,
                                        [](const RobotDecision& d, std::uint32_t r) { return d.robot < r; });
    return found != overrides.decisions.end() && found->robot == robot ? &found->decision : nullptr;
}

/// Those that all could have received.
void forgetMessages(const Scene& scene, WorldState& state) {
    if (state.messages.empty()) return;
    std::int64_t told = state.tick;
    for (const RobotState& robot : state.robots) told = std::min(told, robot.lastControl);
    std::erase_if(state.messages, [&](const SentMessage& m) {
        return m.tick + arrivalTicks(m.latency + m.jitter, scene.tickLength) <= told;
    });
}

/// What became of messages to a robot at this tick.
void traceMessages(const Scenario& scenario, const WorldState& state, std::uint32_t robot, SensingBuffers& buffers,
                   StepTrace& trace) {
    if (state.messages.empty() || !scenario.readsMessages(robot)) return;
    const auto due = buffers.radio.due(scenario.scene(), scenario.teams(), state, robot, StepTrace::outOfRangeNoted);
    trace.transmissions.insert(trace.transmissions.end(), due.begin(), due.end());
}

}  // namespace

void decide(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, const Overrides& overrides,
            StepTrace* trace) {
    forgetMessages(scenario.scene(), state);
    buffers.due.clear();
    buffers.sensing.forget();
    for (std::uint32_t i = 0; i < state.robots.size(); ++i) {
        RobotState& robot = state.robots[i];
        if (robot.nextControl != state.tick) continue;
        robot.nextControl = state.tick + scenario.periodOf(i).ticks;
        buffers.due.push_back(i);
        const Decision* decision = overriding(overrides, i);
        const bool asked = decision == nullptr && overrides.askControllers;
        // Before: sensors remember what they have told.
        if (trace != nullptr && trace->asksUnread)
            observeUnread(scenario, state, i, asked, buffers.sensing, trace->robots[i].unread);
        if (asked) {
            observe(scenario, state, i, scenario.sensorMemory(state, i), buffers.sensing, buffers.observation);
            buffers.decision.clear();
            buffers.decision.wantsAnnotations = trace != nullptr && trace->asksInsights;
            buffers.observation.leaveOut(&scenario.attention(i));
            scenario.controller(i).decide(buffers.observation, scenario.memoryOf(state, i), buffers.decision);
            buffers.observation.leaveOut(nullptr);
            checkMessages(buffers.decision, scenario.scene());
            decision = &buffers.decision;
        }
        if (trace != nullptr && trace->asksInsights) traceMessages(scenario, state, i, buffers.sensing, *trace);
        robot.lastControl = state.tick;
        if (decision != nullptr) obey(scenario, state, i, *decision, trace);
        if (trace == nullptr) continue;
        StepTrace::Robot& traced = trace->robots[i];
        traced.decided = decision != nullptr;
        traced.observed = decision == &buffers.decision;
        if (!trace->asksInsights) continue;
        if (traced.observed) traced.observation = buffers.observation;
        if (decision != nullptr) traced.decision = *decision;
    }
    if (trace != nullptr && !trace->transmissions.empty()) trace->messages = state.messages;
}

void rememberPoses(const Scenario& scenario, WorldState& state) {
    if (scenario.pastDepth() == 0) return;
    const std::span<Pose> now = scenario.past().posesOfNow(state);
    for (std::size_t body = 0; body < now.size(); ++body) now[body] = poseOf(state, body);
}

}  // namespace mrose
