#include "scenario/state_validation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "world/state_fields.h"

namespace mrose {
namespace {

/// Places, speeds, impulses: nothing comes so far, and the kept impulses' single precision has room for them.
constexpr double farthest = 1e9;
/// Commands may ask for more than a robot does.
constexpr double largest = std::numeric_limits<double>::max();

template <class T>
bool within(double bound, const T& value) {
    bool all = true;
    visitNumbers(value, [&](const auto& number) {
        if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(number)>>)
            all = all && std::abs(number) <= bound;
    });
    return all;
}

template <class T>
bool allWithin(double bound, const std::vector<T>& values) {
    return std::all_of(values.begin(), values.end(), [&](const T& value) { return within(bound, value); });
}

bool soundNumbers(const WorldState& state) {
    for (const RobotState& r : state.robots)
        if (!within(farthest, r.pose) || !within(farthest, r.velocity_B) || !within(farthest, r.segment) ||
            !within(largest, r.commandBefore))
            return false;
    return allWithin(farthest, state.objects) && allWithin(farthest, state.contacts) &&
           allWithin(farthest, state.kicks) && allWithin(farthest, state.past) && allWithin(farthest, state.messages) &&
           allWithin(farthest, state.touches) && allWithin(largest, state.commands);
}

/// Of a message.
bool soundDelay(Nanoseconds delay) { return delay >= 0 && delay <= Radio::mostDelay; }

std::string wrongSize(const char* what, std::size_t found, std::size_t expected) {
    if (found == expected) return {};
    return std::to_string(found) + ' ' + what + "; the scenario has " + std::to_string(expected);
}

std::string wrongSizes(const Scenario& scenario, const WorldState& state) {
    const WorldState own = scenario.freshState(0);
    for (std::string wrong : {wrongSize("robots", state.robots.size(), own.robots.size()),
                              wrongSize("objects", state.objects.size(), own.objects.size()),
                              wrongSize("goals", state.goals.size(), own.goals.size()),
                              wrongSize("places for commands", state.commands.size(), own.commands.size()),
                              wrongSize("bytes of motion models' memory", state.motion.size(), own.motion.size()),
                              wrongSize("bytes of controllers' memory", state.memory.size(), own.memory.size()),
                              wrongSize("bytes of sensors' memory", state.sensing.size(), own.sensing.size()),
                              wrongSize("past poses", state.past.size(), own.past.size())})
        if (!wrong.empty()) return wrong;
    return {};
}

bool soundInstant(Nanoseconds time) { return time >= -latestTime && time <= latestTime; }

/// Whether they can be counted with, and no motion has yet to begin.
bool soundInstants(const WorldState& state, Nanoseconds tickLength) {
    const auto soundRobot = [&](const RobotState& r) {
        return std::all_of(r.ready.begin(), r.ready.end(), soundInstant) && r.segment.startTick <= state.tick &&
               soundInstant(r.segment.startTick) && r.lastControl <= state.tick && soundInstant(r.lastControl) &&
               r.nextControl >= state.tick && soundInstant(r.nextControl);
    };
    return state.tick >= 0 && state.tick <= latestTime / tickLength &&
           std::all_of(state.robots.begin(), state.robots.end(), soundRobot) &&
           std::all_of(state.kicks.begin(), state.kicks.end(),
                       [](const PendingKick& kick) { return soundInstant(kick.due); });
}

bool soundSensors(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    const auto sensors = scenario.sensors(robot);
    for (std::size_t k = 0; k < sensors.size(); ++k)
        if (!sensors[k]->sound(scenario.sensorMemory(state, robot, k))) return false;
    return true;
}

bool soundCommands(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    const std::span<const StampedCommand> slots = scenario.commandSlots(state, robot);
    const std::size_t count = state.robots[robot].commandCount;
    if (count > slots.size()) return false;
    for (std::size_t i = 0; i < count; ++i)
        if (!soundInstant(slots[i].time) || (i > 0 && slots[i].time < slots[i - 1].time)) return false;
    return true;
}

}  // namespace

std::string validate(const Scenario& scenario, const WorldState& state) {
    if (std::string wrong = wrongSizes(scenario, state); !wrong.empty()) return wrong;
    const std::size_t bodies = scenario.scene().bodyCount();
    for (std::size_t i = 0; i < state.robots.size(); ++i)
        if (!soundCommands(scenario, state, i))
            return "robot " + std::to_string(i + 1) + " with a broken history of commands";
    for (std::size_t i = 0; i < state.robots.size(); ++i)
        if (!soundSensors(scenario, state, i))
            return "robot " + std::to_string(i + 1) + " with sensors whose memory is broken";
    for (const PendingKick& kick : state.kicks)
        if (kick.robot >= state.robots.size() ||
            kick.manipulator >= scenario.scene().typeOf(kick.robot).manipulators.size())
            return "a kick by a manipulator that is not there";
    for (const SentMessage& message : state.messages)
        if (message.from >= state.robots.size() || (message.to != noBody && message.to >= state.robots.size()) ||
            message.size > message.bytes.size() || message.tick > state.tick || message.tick < 0 ||
            message.number >= mostMessages || !soundDelay(message.latency) || !soundDelay(message.jitter))
            return "a message that is broken, or of a robot that is not there";
    for (const RobotTouch& touch : state.touches)
        if (touch.robot >= state.robots.size() || touch.tick > state.tick || !soundInstant(touch.tick))
            return "a touch of the future, or of a robot that is not there";
    const auto there = [&](std::uint32_t body) { return body < bodies || body == noBody; };
    for (const ContactImpulse& contact : state.contacts)
        if (!there(contact.bodyA) || !there(contact.bodyB)) return "a contact of a body that is not there";
    if (!soundInstants(state, scenario.scene().tickLength))
        return "an instant beyond all runs, or a motion that has yet to begin";
    if (!soundNumbers(state)) return "a number that is not finite, or beyond all that occurs";
    return {};
}

}  // namespace mrose
