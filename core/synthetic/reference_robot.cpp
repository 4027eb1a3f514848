#include "synthetic/reference_robot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/elementary.h"
#include "geometry/point.h"
#include "synthetic/sensor_noise.h"

namespace mrose {
namespace {

enum RobotChannel : std::uint32_t {
    linkJitter,
    samplePhase,
    sampleJitter,
    leftGrip,
    rightGrip,
    bothGrip,
    scrubbing,
    casterStart
};

double towards(double value, double target, double most) { return value + std::clamp(target - value, -most, most); }

double inSteps(double value, double quantum) { return std::round(value / quantum) * quantum; }

}  // namespace

double ReferenceRobot::normal(std::int64_t draw, std::uint32_t channel) const {
    return seed_ ? boxMullerPair({*seed_, draw, 0, channel}).first : 0;
}

ReferenceRobotState ReferenceRobot::start(const Pose& pose) const {
    ReferenceRobotState state;
    state.pose = pose;
    const double phase = seed_ ? uniformNoise({*seed_, 0, 0, samplePhase}) : 0.5;
    state.nextSample = fromSeconds(parameters_.samplingPeriod * phase);
    state.wheels[0].grip = parameters_.wheelNoise * normal(-1, leftGrip);
    state.wheels[1].grip = parameters_.wheelNoise * normal(-1, rightGrip);
    state.commonGrip = parameters_.commonNoise * normal(-1, bothGrip);
    state.extraScrub = parameters_.scrubNoise * normal(-1, scrubbing);
    state.casterAngle = 0.3 * normal(-1, casterStart);
    return state;
}

ReferenceRobotState ReferenceRobot::issue(ReferenceRobotState state, const Command& command) const {
    return issue(state, command, state.time);
}

ReferenceRobotState ReferenceRobot::issue(ReferenceRobotState state, const Command& command, Nanoseconds time) const {
    const double delay = parameters_.deadTime + parameters_.deadTimeJitter * normal(state.issued++, linkJitter);
    if (state.linkSize == ReferenceRobotState::linkCapacity) return state;
    const Nanoseconds before = state.linkSize > 0 ? state.link[state.linkSize - 1].time : 0;
    state.link[state.linkSize++] = {std::max(before, time + fromSeconds(std::max(delay, 0.0))), command};
    return state;
}

ReferenceRobotState ReferenceRobot::next(ReferenceRobotState state) const {
    constexpr double seconds = toSeconds(step);
    if (state.time >= state.nextSample) sampleCommand(state);
    if (state.time % fromSeconds(parameters_.servoPeriod) == 0) {
        servo(state);
        wander(state);
    }
    turnWheels(state, seconds);
    move(state, seconds);
    state.time += step;
    return state;
}

void ReferenceRobot::sampleCommand(ReferenceRobotState& state) const {
    std::size_t arrived = 0;
    while (arrived < state.linkSize && state.link[arrived].time <= state.time) ++arrived;
    if (arrived > 0) {
        state.command = state.link[arrived - 1].command;
        std::copy(state.link.begin() + arrived, state.link.begin() + state.linkSize, state.link.begin());
        state.linkSize -= arrived;
    }
    const double wait = parameters_.samplingPeriod + parameters_.samplingJitter * normal(state.samples++, sampleJitter);
    state.nextSample += std::max(fromSeconds(wait), step);
}

/// The set-points come nearer to the command, and each wheel's loop sets its drive.
void ReferenceRobot::servo(ReferenceRobotState& state) const {
    const ReferenceRobotParameters& p = parameters_;
    const double v = std::clamp(state.command.v, -p.largestSpeed, p.largestSpeed);
    const double w = std::clamp(state.command.w, -p.largestTurn, p.largestTurn);
    state.setPoint.v = towards(state.setPoint.v, v, p.acceleration * p.servoPeriod);
    state.setPoint.w = towards(state.setPoint.w, w, p.turnAcceleration * p.servoPeriod);
    for (std::size_t i = 0; i < 2; ++i) {
        ReferenceRobotState::Wheel& wheel = state.wheels[i];
        const double side = i == 0 ? -0.5 : 0.5;
        const double speed = inSteps(state.setPoint.v + side * p.track * state.setPoint.w, p.setPointQuantum);
        const double wanted = std::clamp(speed, -p.largestWheelSpeed, p.largestWheelSpeed);
        const double counted = std::floor(wheel.travel / p.encoderQuantum) * p.encoderQuantum;
        const double error = wanted - (counted - wheel.counted) / p.servoPeriod;
        const bool rests = wanted == 0 && counted == wheel.counted;
        wheel.counted = counted;
        const double integral = rests ? 0 : wheel.integral + p.integral * p.servoPeriod * error;
        const double drive = wanted + p.proportional * error + integral;
        wheel.drive = std::clamp(drive, -p.largestDrive, p.largestDrive);
        if (drive == wheel.drive) wheel.integral = integral;  // no wind-up at full voltage
    }
}

/// What differs from run to run goes on.
void ReferenceRobot::wander(ReferenceRobotState& state) const {
    const ReferenceRobotParameters& p = parameters_;
    const std::int64_t period = state.time / fromSeconds(p.servoPeriod);
    const double kept = exponential(-p.servoPeriod / p.gripTime), fresh = std::sqrt(1 - kept * kept);
    const auto go = [&](double& value, double deviation, RobotChannel channel) {
        value = kept * value + fresh * deviation * normal(period, channel);
    };
    go(state.wheels[0].grip, p.wheelNoise, leftGrip);
    go(state.wheels[1].grip, p.wheelNoise, rightGrip);
    go(state.commonGrip, p.commonNoise, bothGrip);
    go(state.extraScrub, p.scrubNoise, scrubbing);
}

void ReferenceRobot::turnWheels(ReferenceRobotState& state, double seconds) const {
    const ReferenceRobotParameters& p = parameters_;
    const double stoppedByFriction = p.friction / p.motorLag * seconds;  // m/s within this step
    std::array<double, 2> acceleration{};
    std::array<bool, 2> stuck{};
    for (std::size_t i = 0; i < 2; ++i) {
        const ReferenceRobotState::Wheel& wheel = state.wheels[i];
        stuck[i] = std::abs(wheel.speed) <= stoppedByFriction && std::abs(wheel.drive) < p.stiction;
        const double direction = wheel.speed != 0 ? wheel.speed : wheel.drive;
        if (!stuck[i])
            acceleration[i] = (wheel.drive - wheel.speed - std::copysign(p.friction, direction)) / p.motorLag;
    }
    for (std::size_t i = 0; i < 2; ++i) {
        ReferenceRobotState::Wheel& wheel = state.wheels[i];
        wheel.speed += seconds * ((1 - p.coupling) * acceleration[i] + p.coupling * acceleration[1 - i]);
        if (stuck[i]) wheel.speed = 0;
        wheel.travel += seconds * wheel.speed;
    }
}

void ReferenceRobot::move(ReferenceRobotState& state, double seconds) const {
    const ReferenceRobotParameters& p = parameters_;
    std::array<double, 2> ground{};
    for (std::size_t i = 0; i < 2; ++i)
        ground[i] = state.wheels[i].speed * p.wheelScale[i] * (1 + state.wheels[i].grip + state.commonGrip);
    const double rolled = (ground[0] + ground[1]) / 2, turned = (ground[1] - ground[0]) / p.track;

    // The caster turns until it trails; on its way it pushes the robot aside.
    const double alongCaster = rolled, acrossCaster = -p.casterOffset * turned;
    const double casterSpeed = length({alongCaster, acrossCaster});
    const double misalignment = casterSpeed > 0 ? arcTangent(acrossCaster, alongCaster) - state.casterAngle : 0;
    const double aside = sine(misalignment);
    state.casterAngle = wrapAngle(state.casterAngle + seconds * casterSpeed / p.casterTrail * aside);
    const double push = p.casterTurn * casterSpeed / (casterSpeed + 0.05) * aside;

    const double lost = std::abs(rolled * turned);
    state.velocity.v = rolled - std::copysign(std::min(p.turnDrag * lost, std::abs(rolled)), rolled);
    state.velocity.w = turned * (1 - p.scrub - state.extraScrub - p.scrubAtSpeed * std::abs(rolled)) + push;
    const double sideways = -p.sideSlip * rolled * turned;
    state.pose = state.pose * exp(Twist{state.velocity.v * seconds, sideways * seconds, state.velocity.w * seconds});
}

ReferenceRobotState ReferenceRobot::pushed(ReferenceRobotState state, const Velocity& velocity) const {
    const ReferenceRobotParameters& p = parameters_;
    const double kept = 1 - p.scrub - state.extraScrub - p.scrubAtSpeed * std::abs(velocity.v);
    const double v = velocity.v - state.velocity.v, w = (velocity.w - state.velocity.w) / std::max(kept, 0.5);
    for (std::size_t i = 0; i < 2; ++i) {
        ReferenceRobotState::Wheel& wheel = state.wheels[i];
        const double side = i == 0 ? -0.5 : 0.5;
        wheel.speed += (v + side * p.track * w) / (p.wheelScale[i] * (1 + wheel.grip + state.commonGrip));
    }
    state.velocity = velocity;
    return state;
}

}  // namespace mrose
