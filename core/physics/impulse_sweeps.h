#pragma once

#include <span>
#include <vector>

#include "physics/pair_block.h"

namespace mrose {

/// Finds the impulses of any number of pairs, nearly. Keeps memory for speed alone.
///
/// Sweeps of Gauss-Seidel pair by pair, which go on along the way that they went (nonsmooth nonlinear conjugate
/// gradients: Silcowitz, Niebe and Erleben 2010).
class ImpulseSweeps {
public:
    /// Whether the sweeps settled: what they changed, and would still change at the pace they went, is little.
    bool find(std::span<RigidBody> bodies, std::span<PressedPair> pairs, int mostSweeps);

private:
    struct Member {
        PairBlock block;
        std::uint32_t a, b;
        PairBlock::Triple impulses, way{}, newest{};  ///< N s; the search's direction; the last sweep's change
    };
    /// The same in bodies: the search's direction, and how they moved when the last sweep began.
    struct Way {
        Point velocity;
        double rotation = 0;
        Point velocityBefore;
        double rotationBefore = 0;
    };
    /// How much a sweep changed: twice the energy of its change, and the fastest change of a spot's velocity, m/s.
    struct Change {
        double square = 0, fastest = 0;
    };
    bool settle(std::span<RigidBody> bodies, int mostSweeps);
    Change sweep(std::span<RigidBody> bodies);
    void goOn(std::span<RigidBody> bodies, double share);

    std::vector<Member> members_;
    std::vector<Way> ways_;  ///< of the bodies
};

}  // namespace mrose
