#pragma once

#include <span>
#include <vector>

#include "physics/pair_block.h"

namespace mrose {

/// Finds the impulses of few pairs exactly, however different the bodies' masses are. Keeps memory for speed alone.
///
/// One pair has a closed form. Of several, a sweep pair by pair finds who presses and who slides; for that the rest is
/// linear (a semismooth Newton step); the next sweep says whether it was right.
class ExactImpulses {
public:
    static constexpr std::size_t mostPairs = 24;
    /// False, and the bodies as they were, where sweeps and steps do not come to agree. At most mostPairs pairs.
    bool find(std::span<RigidBody> bodies, std::span<PressedPair> pairs);

private:
    /// One direction in which a pair presses or rubs.
    struct Line {
        PairBlock::Line of;
        bool rubs;
    };
    /// A pair's first line; its last is the tangent.
    struct Member {
        PairBlock block;
        int first;
        int tangent() const { return first + block.spots(); }
    };
    /// What Newton's step looks for: more of an impulse along a line and, where the pair slides, along its tangent too.
    struct Unknown {
        int line, tangent;
        double slides;
    };
    void setUp(std::span<const RigidBody> bodies, std::span<const PressedPair> pairs);
    void couple(const RigidBody& body, const Member& one, bool second, const Member& other, bool ofOther);
    void add(int line, double impulse);
    bool settle();
    double sweep();
    void newtonSteps();
    bool newtonStep();
    void findUnknowns();
    void solveUnknowns();
    double* effectsOf(int line) { return &effects_[static_cast<std::size_t>(line) * lines_.size()]; }

    std::vector<Member> members_;
    std::vector<Line> lines_;
    std::vector<double> impulses_;  ///< of the lines, N s
    std::vector<double> excess_;    ///< along them, m/s faster than wanted
    std::vector<double> begin_;     ///< where the search begins, N s
    std::vector<double> effects_;   ///< of each line on each: m/s for each N s
    std::vector<Unknown> unknowns_;
    std::vector<double> equations_, more_;
};

}  // namespace mrose
