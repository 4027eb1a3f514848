#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/environment.h"
#include "world/memory.h"
#include "world/noise.h"
#include "world/world_state.h"

namespace mrose {

struct ObjectType;

/// What an object's motion model sees of one body.
struct ObjectInput {
    const ObjectState& state;
    const ObjectType& type;
    const FloorSurface& floor;
    /// Share by which the floor's frictions vary at random from tick to tick, 0 ... 1.
    double randomFactor = 0;
    double duration = 0;  ///< s, at most the tick's length
    /// Of this body in this tick, also where contact cuts the tick in two; further draws have other parts of its
    /// channel.
    NoiseKey noise;
    std::span<std::byte> memory = {};  ///< what the model remembers of the body, read and written
};

/// How an object moves while nothing touches it. Const itself; one serves any number of bodies, and what it remembers
/// of each lies in the world's state.
class ObjectModel {
public:
    virtual ~ObjectModel() = default;

    /// Bytes that it remembers of each body, constant; multiples of 8 lie aligned for anything.
    virtual std::size_t memorySize() const { return 0; }
    /// Fills the memory at a run's start, and where a ball is put back after a goal. All zero before.
    virtual void start(std::span<std::byte> /*memory*/) const {}
    /// What such a memory says.
    virtual void explain(std::span<const std::byte> /*memory*/, MemoryEntries& /*entries*/) const {}

    /// Where the body is `duration` later. A body at rest is asked too. Inputs must be finite.
    virtual ObjectState after(const ObjectInput& input) const = 0;
};

/// The same where contact keeps the body in its place meanwhile: how its velocities have changed.
ObjectState heldInPlace(const ObjectModel& model, const ObjectInput& input);

}  // namespace mrose
