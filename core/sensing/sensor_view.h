#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/obstacle_index.h"
#include "scene/scene.h"
#include "sensing/sensing_buffers.h"
#include "world/noise.h"
#include "world/noise_channel.h"
#include "world/past_poses.h"

namespace mrose {

/// What a sensor has before it at one measurement: the world as it is and was, whose sensor it is, its draws. Lags are
/// in ticks before the measurement arrives.
struct SensorView {
    static constexpr std::size_t mostReadings = 32;  ///< that one sensor gives
    static constexpr std::size_t mostSensors = 256;  ///< of a robot

    const Scene& scene;
    const ObstacleIndex& obstacles;
    const PastPoses& past;
    const WorldState& state;
    std::uint32_t robot;
    SensingBuffers& buffers;
    std::uint32_t sensor = 0;     ///< its place among the robot's
    std::uint32_t wanted = ~0u;   ///< readings that the controller reads: bit k for Sensor::gives()[k]
    double sinceLast = 0;         ///< s since the measurement before
    std::int64_t arrivedAgo = 0;  ///< ticks
    Nanoseconds measured = 0;     ///< the instant, of a sensor that is exact()

    bool wants(std::size_t reading) const { return (wanted >> reading & 1) != 0; }
    /// For the `draw`-th draw of this measurement.
    NoiseKey key(std::uint32_t draw) const {
        NoiseKey key = this->key(NoiseChannel::sensor, sensor << 16 | (draw & 0xffff));
        key.tick ^= static_cast<std::int64_t>(std::uint64_t{draw >> 16} << 48);  // no run has so many ticks
        return key;
    }
    NoiseKey key(NoiseChannel kind, std::uint32_t part) const {
        return {state.seed, state.tick - arrivedAgo, robot, channelOf(kind, part)};
    }
    const RobotType& type() const { return scene.typeOf(robot); }
    std::int64_t lagOf(Nanoseconds latency) const { return scene.ticksOf(latency); }
    Nanoseconds timeBefore(std::int64_t lag) const { return scene.timeOf(state.tick - arrivedAgo - lag); }
    const Pose& poseBefore(std::size_t body, std::int64_t lag) const {
        return past.poseBefore(state, body, arrivedAgo + lag);
    }
    /// An instant between two ticks: so many ticks before now, and so much of a tick earlier.
    struct Moment {
        std::int64_t lag;
        double earlier;
    };
    Moment momentOf(Nanoseconds time) const {
        const Nanoseconds ago = scene.timeOf(state.tick) - time;
        return {ago / scene.tickLength,
                static_cast<double>(ago % scene.tickLength) / static_cast<double>(scene.tickLength)};
    }
    /// Where a body was then, not after the measurement has arrived.
    Pose poseAt(std::size_t body, const Moment& moment) const {
        return past.poseBetween(state, body, moment.lag, moment.earlier);
    }
    Pose poseAt(std::size_t body, Nanoseconds time) const { return poseAt(body, momentOf(time)); }
    const BodyMap& bodiesAt(const Moment& moment) const {
        return buffers.bodiesBefore(past, state, moment.lag, moment.earlier);
    }
    const BodyMap& bodiesAt(Nanoseconds time) const { return bodiesAt(momentOf(time)); }
    const BodyMap& bodiesBefore(std::int64_t lag) const { return buffers.bodiesBefore(past, state, arrivedAgo + lag); }
};

}  // namespace mrose
