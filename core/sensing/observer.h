#pragma once

#include <cstdint>

#include "scenario/scenario.h"
#include "sensing/sensing_buffers.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {

/// Who perceives, and when.
struct Observer {
    const Scenario& scenario;
    const WorldState& state;
    std::uint32_t robot;
    SensingBuffers& buffers;

    NoiseKey key(NoiseChannel kind, std::uint32_t part = 0) const {
        return {state.seed, state.tick, robot, channelOf(kind, part)};
    }
    const Perception& perception() const { return scenario.scene().typeOf(robot).perception; }
    std::int64_t lagOf(Nanoseconds latency) const { return scenario.scene().ticksOf(latency); }
    Nanoseconds timeBefore(std::int64_t lag) const { return scenario.scene().timeOf(state.tick - lag); }
    const Pose& poseBefore(std::size_t body, std::int64_t lag) const { return scenario.poseBefore(state, body, lag); }
    const BodyMap& bodiesBefore(std::int64_t lag) const { return buffers.bodiesBefore(scenario, state, lag); }
};

}  // namespace mrose
