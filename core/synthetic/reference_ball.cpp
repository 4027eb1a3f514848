#include "synthetic/reference_ball.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/elementary.h"
#include "scene/floor_motion.h"
#include "scene/scene.h"
#include "synthetic/sensor_noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

/// The parts of a body's channel that the floor's own draw leaves.
enum BallDraw : std::uint32_t { bump = 1, heavySide };

NoiseKey ballKey(const ObjectInput& input, BallDraw draw) {
    NoiseKey key = input.noise;
    key.channel = channelOf(NoiseChannel::floorFriction, draw);
    return key;
}

Point unit(const Point& v) {
    const double size = length(v);
    return size > 0 ? (1 / size) * v : Point{};
}

Point turned(const Point& v, double angle) {
    const auto [s, c] = sineCosine(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Evenly over the sphere.
void placeHeavySide(ReferenceBall::Memory& memory, const NoiseKey& key) {
    const NoisePair u = uniformPair(key);
    const double z = 2 * u.first - 1, around = std::sqrt(1 - z * z);
    const Point there = around * towards(2 * std::numbers::pi * u.second);
    memory = {there.x, there.y, z, 1};
}

}  // namespace

void ReferenceBall::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    const auto& kept = as<Memory>(memory);
    if (kept.begun == 0) return;
    entries.add("synthetic", "reference ball");
    entries.add("heavy_x", kept.heavyX);
    entries.add("heavy_y", kept.heavyY);
    entries.add("heavy_z", kept.heavyZ);
}

double ReferenceBall::rollingDeceleration(const Point& place, const Point& velocity, double floor) const {
    const double along = dot(unit(velocity), pile_);
    const double patch = sine(2.3 * place.x + 0.7) * sine(1.7 * place.y - 0.4);
    return floor * (p_.atRest + p_.perSpeed * length(velocity)) * (1 - p_.grain * along) * (1 + p_.patches * patch);
}

/// Rolls the heavy side with the ball: by Rodrigues' formula about the axis of its spin.
void ReferenceBall::turn(Memory& memory, const ObjectState& ball, double reach, double seconds) const {
    const double x = -ball.roll_W.y / reach, y = ball.roll_W.x / reach, z = ball.velocity_W.rotation;
    const double rate = std::sqrt(x * x + y * y + z * z);
    if (rate == 0) return;
    const double ax = x / rate, ay = y / rate, az = z / rate;
    const auto [s, c] = sineCosine(rate * seconds);
    const double hx = memory.heavyX, hy = memory.heavyY, hz = memory.heavyZ;
    const double along = (ax * hx + ay * hy + az * hz) * (1 - c);
    const double nx = c * hx + s * (ay * hz - az * hy) + along * ax;
    const double ny = c * hy + s * (az * hx - ax * hz) + along * ay;
    const double nz = c * hz + s * (ax * hy - ay * hx) + along * az;
    const double size = std::sqrt(nx * nx + ny * ny + nz * nz);
    memory.heavyX = nx / size, memory.heavyY = ny / size, memory.heavyZ = nz / size;
}

ObjectState ReferenceBall::after(const ObjectInput& input) const {
    if (input.state.velocity_W == Twist{} && input.state.roll_W == Point{}) return input.state;
    Memory fresh;
    Memory& memory = input.memory.empty() ? fresh : as<Memory>(input.memory);
    if (memory.begun == 0) placeHeavySide(memory, ballKey(input, heavySide));
    const double floorFactor =
        input.randomFactor == 0 ? 1 : 1 + input.randomFactor * (2 * uniformNoise(input.noise) - 1);
    const double sliding = input.floor.slidingFriction * floorFactor * gravity;
    const double rolling = input.floor.rollingDeceleration * floorFactor;
    const double inertia = input.type.inertia, reach = input.type.shape->reach;
    const double pull = p_.eccentricity * gravity / (reach * inertia);
    const double wander = p_.bumps * laplaceNoise(ballKey(input, bump));
    const auto steps = static_cast<int>(std::ceil(input.duration / p_.step - 1e-9));
    const double h = input.duration / std::max(steps, 1);

    ObjectState ball = input.state;
    Point velocity{ball.velocity_W.x, ball.velocity_W.y}, roll = ball.roll_W, way;
    for (int i = 0; i < steps; ++i) {
        const Point before = velocity;
        // What the heavy side's weight does to the spin.
        roll = roll + (h * pull) * Point{memory.heavyX, memory.heavyY};
        // Friction takes from the slip what it gives to the spin; not more than there is.
        const Point slip = velocity - roll;
        const double slipSpeed = length(slip);
        if (slipSpeed > 0) {
            const double grip = sliding * slipSpeed / (slipSpeed + p_.creep) *
                                (1 + p_.stribeck * p_.fastSlip / (slipSpeed + p_.fastSlip));
            const double lost = std::min(h * grip, slipSpeed / (1 + 1 / inertia));
            velocity = velocity - (lost / slipSpeed) * slip;
            roll = roll + (lost / (inertia * slipSpeed)) * slip;
        }
        // The carpet, of both alike. What it can hold, it holds.
        const Point place{ball.pose.x, ball.pose.y};
        const double resistance = h * rollingDeceleration(place, velocity, rolling);
        const auto slowed = [&](const Point& v) { return v - std::min(resistance, length(v)) * unit(v); };
        velocity = slowed(velocity);
        roll = slowed(roll);
        if (length(velocity) > 0) {
            velocity = velocity + (p_.drift * resistance) * pile_;
            roll = roll + (p_.drift * resistance) * pile_;
        }
        way = (h / 2) * (before + velocity);
        ball.pose.x += way.x;
        ball.pose.y += way.y;
        ball.pose.heading += h * ball.velocity_W.rotation;
        double& spin = ball.velocity_W.rotation;
        const double kept = decay(h / p_.spinDecay) * std::abs(spin), rubbed = h * rolling / (inertia * reach);
        spin = std::copysign(std::max(0.0, kept - rubbed), spin);
        ball.roll_W = roll;
        turn(memory, ball, reach, h);
    }
    // It rests where one step's resistance is more than all that it has: its weight does not move it.
    const double rest = h * p_.atRest * rolling;
    if (length(velocity) <= rest && length(roll) <= std::max(rest, 2 * h * pull)) velocity = roll = {};
    const double angle = wander * std::sqrt(input.duration * length(velocity));
    velocity = turned(velocity, angle);
    roll = turned(roll, angle);
    ball.velocity_W.x = velocity.x;
    ball.velocity_W.y = velocity.y;
    ball.roll_W = roll;
    if (velocity == Point{} && roll == Point{} && std::abs(ball.velocity_W.rotation) == 0) ball.velocity_W.rotation = 0;
    return ball;
}

std::shared_ptr<const ObjectModel> referenceBall() {
    static const std::shared_ptr<const ObjectModel> model = std::make_shared<const ReferenceBall>();
    return model;
}

}  // namespace mrose
