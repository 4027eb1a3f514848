#pragma once

#include <cstdint>

namespace mrose {

/// What a draw of noise is for: the kind in the upper byte, which body or part it concerns in the rest.
enum class NoiseChannel : std::uint32_t {
    motion,
    restitution,
    contactFriction,
    floorFriction,
    selfLocalisation,
    velocity,
    sightOfRobots,
    sightOfObjects,
    controller,
    trial,
    bearingBias,
    sensor,  ///< the part: which sensor of the robot, and which draw
    radio,   ///< of the receiver; the part: the message's number, and its sender
    kick,    ///< of the kicking robot; the part: which manipulator, and which draw
    sample,  ///< no draw of a run, but the seed of one
};

constexpr std::uint32_t channelOf(NoiseChannel kind, std::uint32_t part = 0) {
    return static_cast<std::uint32_t>(kind) << 24 | (part & 0xffffff);
}

}  // namespace mrose
