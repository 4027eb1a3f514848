#include "synthetic/reference_model.h"

#include <cmath>

#include "world/noise_channel.h"

namespace mrose {
namespace {

/// Velocities nearer than this are those that it left: the way through a period ends there within rounding.
constexpr double sameVelocity = 1e-9;  // m/s, rad/s

Nanoseconds nextStep(Nanoseconds time) {
    constexpr Nanoseconds step = ReferenceRobot::step;
    return (time >= 0 ? (time + step - 1) / step : time / step) * step;
}

}  // namespace

std::uint64_t ReferenceModel::robotSeed(const NoiseKey& noise) {
    return noiseBits({noise.seed, 0, noise.robot, channelOf(NoiseChannel::motion, 1)});
}

/// At its first period it has to know what is on its way to it.
Nanoseconds ReferenceModel::lookBack() const {
    const double late = parameters_.deadTime + 6 * parameters_.deadTimeJitter;
    return fromSeconds(late + parameters_.samplingPeriod + 6 * parameters_.samplingJitter);
}

MotionModel::DeadTimes ReferenceModel::deadTimes() const {
    const Nanoseconds both = fromSeconds(parameters_.deadTime + parameters_.samplingPeriod / 2);
    return {both, both};
}

bool ReferenceModel::sameAs(const MotionModel& other) const {
    const auto* reference = dynamic_cast<const ReferenceModel*>(&other);
    return reference != nullptr && reference->parameters_ == parameters_ && reference->period_ == period_;
}

void ReferenceModel::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    const auto& kept = as<Memory>(memory);
    if (kept.begun == 0) return;
    const ReferenceRobotState& robot = kept.robot;
    entries.add("synthetic", "reference robot");
    entries.add("commands_on_their_way", static_cast<double>(robot.linkSize));
    entries.add("command_v", robot.command.v, "m/s");
    entries.add("command_w", robot.command.w, "rad/s");
    entries.add("set_point_v", robot.setPoint.v, "m/s");
    entries.add("set_point_w", robot.setPoint.w, "rad/s");
    entries.add("left_wheel", robot.wheels[0].speed, "m/s");
    entries.add("right_wheel", robot.wheels[1].speed, "m/s");
    entries.add("left_drive", robot.wheels[0].drive, "m/s");
    entries.add("right_drive", robot.wheels[1].drive, "m/s");
    entries.add("caster", robot.casterAngle, "rad");
}

void ReferenceModel::predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        Memory fresh;
        steps[i] = step(inputs[i], inputs[i].memory.empty() ? fresh : as<Memory>(inputs[i].memory));
    }
}

void ReferenceModel::begin(const ReferenceRobot& robot, const MotionInput& input, Memory& memory) const {
    memory = {};
    memory.begun = 1;
    memory.robot = robot.start({});
    memory.lastRead = input.start - lookBack();
    memory.robot.command = input.commands.at(memory.lastRead);
    memory.robot.setPoint = {input.velocity.v, input.velocity.w};
}

MotionStep ReferenceModel::step(const MotionInput& input, Memory& memory) const {
    const ReferenceRobot robot(input.noise ? std::optional(robotSeed(*input.noise)) : std::nullopt, parameters_);
    if (memory.begun == 0) begin(robot, input, memory);
    ReferenceRobotState& state = memory.robot;
    memory.switchedOn = input.start - state.time;
    const Velocity &left = state.velocity, &now = input.velocity;
    if (std::abs(now.v - left.v) > sameVelocity || std::abs(now.w - left.w) > sameVelocity)
        state = robot.pushed(state, now);
    for (std::size_t i = 0; i < input.commands.size(); ++i)
        if (const Nanoseconds issued = input.commands.issueTime(i); issued > memory.lastRead)
            state = robot.issue(state, input.commands.command(i), nextStep(issued - memory.switchedOn));
    memory.lastRead = input.start;
    state.pose = {};
    for (Nanoseconds passed = 0; passed < period_; passed += ReferenceRobot::step) state = robot.next(state);
    return {state.pose, state.velocity};
}

}  // namespace mrose
