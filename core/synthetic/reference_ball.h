#pragma once

#include <cstdint>
#include <memory>

#include "geometry/point.h"
#include "scene/object_model.h"

namespace mrose {

/// A ball of another class than FloorMotion: synthetic. Constants are assumptions; what of them depends on the place,
/// the environment's floor says in the mean.
struct ReferenceBallParameters {
    double step = 0.002;  ///< s, at most

    // Sliding: a friction that shrinks with the slip's speed, and creep instead of a slip that ends.
    double creep = 0.03;     ///< m/s: at this slip half of the friction acts
    double stribeck = 0.25;  ///< share by which it is more at small slips than at large ones ...
    double fastSlip = 1.0;   ///< m/s: ... of which half is left at this one

    // Rolling: slower balls lose less, and the carpet's grain counts.
    double atRest = 0.8;          ///< share of the floor's rolling deceleration for a ball that hardly rolls ...
    double perSpeed = 0.25;       ///< s/m: ... and what each m/s adds to it
    double grain = 0.12;          ///< share: more against the pile, less along it
    double grainDirection = 0.6;  ///< rad, of the pile
    double patches = 0.15;        ///< share: in waves over the place
    double drift = 0.05;          ///< share of the deceleration that acts along the pile
    double bumps = 0.012;         ///< rad for the root of a metre: how the direction wanders, by Laplace's distribution

    // Mass.
    double eccentricity = 0.0008;  ///< m: how far its centre of mass lies from its centre
    double spinDecay = 0.8;        ///< s: about the vertical, beside friction
};

/// Slip and spin stay apart: the one drives the other by a friction that depends on its speed, so that a ball never
/// rolls quite without slip. Its heavy side turns with it and pulls it aside and along; the floor's resistance depends
/// on speed, direction and place. In steps of 2 ms; what is heavy where is memory in the world's state.
class ReferenceBall final : public ObjectModel {
public:
    explicit ReferenceBall(const ReferenceBallParameters& parameters = {})
        : p_(parameters), pile_(towards(parameters.grainDirection)) {}

    struct Memory {
        double heavyX = 0, heavyY = 0, heavyZ = 0;  ///< unit vector to the heavy side, along the world's axes
        std::uint64_t begun = 0;                    ///< 0 before the first tick, which draws where it is
    };
    static_assert(sizeof(Memory) == 32);

    const ReferenceBallParameters& parameters() const { return p_; }
    std::size_t memorySize() const override { return sizeof(Memory); }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    ObjectState after(const ObjectInput& input) const override;

    /// m/s2: how much a ball that rolls with `velocity` at `place` is slowed down.
    double rollingDeceleration(const Point& place, const Point& velocity, double floor) const;

private:
    void turn(Memory& memory, const ObjectState& ball, double reach, double seconds) const;

    ReferenceBallParameters p_;
    Point pile_;
};

/// One for all.
std::shared_ptr<const ObjectModel> referenceBall();

}  // namespace mrose
