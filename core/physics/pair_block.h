#pragma once

#include <optional>

#include "physics/impulses.h"

namespace mrose {

/// How the impulses of one pair act on its own spots: what they must be is found in closed form.
class PairBlock {
public:
    /// Along the first spot's normal, the second's, and the tangent: N s or m/s.
    using Triple = std::array<double, 3>;
    static constexpr int tangent = 2;
    /// Velocities that change by no more have been found, nearly: m/s.
    static constexpr double settled = 2e-3;

    PairBlock(const RigidBody& a, const RigidBody& b, const PressedPair& pair);

    /// How much faster than wanted the spots part; along the tangent, how fast they slip. m/s.
    Triple excess(const RigidBody& a, const RigidBody& b) const;
    /// The impulses that are wanted where `free` is the excess without any of the pair's own.
    Triple wanted(const Triple& free);
    /// Changes the excess by what the impulses do.
    void add(const Triple& impulses, double factor, Triple& excess) const;
    void give(RigidBody& a, RigidBody& b, const Triple& impulses) const;

    /// One direction in which the pair can press or rub.
    struct Line {
        Point axis;
        double leverOfA = 0, leverOfB = 0, wanted = 0;
    };
    const Line& line(int i) const { return lines_[i]; }
    int spots() const { return spots_; }
    double friction() const { return friction_; }
    double effect(int of, int on) const { return effects_[of][on]; }  ///< m/s for each N s

private:
    /// The two normals' effects on each other where the tangent's impulse follows from them, made ready.
    struct Normals {
        Normals(double on00, double on01, double on10, double on11, int spots);
        /// The impulses; false where there are none.
        bool solve(double free0, double free1, double& x, double& y) const;
        double on01, on10;          ///< of the second on the first, of the first on the second
        double inverse0, inverse1;  ///< of their effects on themselves; 0: they have none
        double scale;               ///< of the inverse matrix; 0: the two press as one
        double on00, on11;
        int spots;
    };
    const Normals& sliding(bool forward);

    std::array<Line, 3> lines_;
    std::array<Triple, 3> effects_{};
    double friction_;
    int spots_;
    double inverseTangent_ = 0;
    std::array<double, 2> borrowed_{};  ///< what sticking takes of a normal's free excess for each m/s of slip
    std::optional<Normals> sticking_;
    std::array<std::optional<Normals>, 2> sliding_;  ///< made when asked for: rubbing backward, forward
};

}  // namespace mrose
