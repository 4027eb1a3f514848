#pragma once

#include <algorithm>
#include <cmath>

#include "physics/impulses.h"

namespace mrose {

/// How the impulses of one pair act on its own spots: what they must be is found in closed form.
class PairBlock {
public:
    /// Along the first spot's normal, the second's, and the tangent: N s or m/s. Without a second spot its entry means
    /// nothing, but for impulses: 0.
    using Triple = std::array<double, 3>;
    static constexpr int tangent = 2;
    /// Velocities that change by no more have been found, nearly: m/s.
    static constexpr double settled = 2e-3;

    PairBlock(const RigidBody& a, const RigidBody& b, const PressedPair& pair);

    /// How much faster than wanted the spots part; along the tangent, how fast they slip. m/s.
    Triple excess(const RigidBody& a, const RigidBody& b) const {
        const Point apart = b.velocity - a.velocity;
        const double parts = dot(normal_, apart);
        const auto with = [&](int i) { return b.rotation * leverOfB_[i] - a.rotation * leverOfA_[i]; };
        return {parts + with(0) - wanted_[0], parts + with(1) - wanted_[1], cross(normal_, apart) + with(tangent)};
    }
    /// The impulses that are wanted where `free` is the excess without any of the pair's own.
    Triple wanted(const Triple& free) {
        double x = 0, y = 0;
        if (sticking_.solve(free[0] - borrowed_[0] * free[tangent], free[1] - borrowed_[1] * free[tangent], x, y)) {
            const double t = -inverseTangent_ * slip(free, x, y);
            if (std::abs(t) <= friction_ * (x + y)) return {x, y, t};
            return slidingWanted(free, t > 0);
        }
        return slidingWanted(free, false);
    }
    /// Changes the excess by what the impulses do.
    void add(const Triple& impulses, double factor, Triple& excess) const {
        for (int i = 0; i < 3; ++i) {
            const Triple& of = effects_[i];
            excess[i] += factor * (of[0] * impulses[0] + of[1] * impulses[1] + of[tangent] * impulses[tangent]);
        }
    }
    void give(RigidBody& a, RigidBody& b, const Triple& impulses) const {
        const double presses = impulses[0] + impulses[1], rubs = impulses[tangent];
        const Point impulse{presses * normal_.x - rubs * normal_.y, presses * normal_.y + rubs * normal_.x};
        const auto turn = [&](const Triple& lever) {
            return impulses[0] * lever[0] + impulses[1] * lever[1] + rubs * lever[tangent];
        };
        a.push(-1 * impulse, -turn(leverOfA_));
        b.push(impulse, turn(leverOfB_));
    }

    /// One direction in which the pair can press or rub.
    struct Line {
        Point axis;
        double leverOfA = 0, leverOfB = 0;
    };
    Line line(int i) const {
        return {i == tangent ? Point{-normal_.y, normal_.x} : normal_, leverOfA_[i], leverOfB_[i]};
    }
    int spots() const { return spots_; }
    double friction() const { return friction_; }
    double effect(int of, int on) const { return effects_[of][on]; }  ///< m/s for each N s

private:
    /// The two normals' effects on each other where the tangent's impulse follows from them, made ready.
    struct Normals {
        Normals() = default;
        Normals(double on00, double on01, double on10, double on11, int spots);
        /// The impulses; false where there are none. A linear complementarity problem of two, by its cases: the first
        /// alone, the second alone, both.
        bool solve(double free0, double free1, double& x, double& y) const {
            y = 0;
            if (inverse0 == 0) return false;
            x = std::max(0.0, -free0 * inverse0);
            if (spots < 2 || free1 + on10 * x >= 0) return true;
            if (inverse1 == 0) return false;
            x = 0;
            y = std::max(0.0, -free1 * inverse1);
            if (free0 + on01 * y >= 0) return true;
            if (scale == 0) return false;
            x = std::max(0.0, scale * (on01 * free1 - on11 * free0));
            y = std::max(0.0, scale * (on10 * free0 - on00 * free1));
            return true;
        }
        double on00 = 0, on01 = 0, on10 = 0, on11 = 0;  ///< of the first on the first, of the second on the first ...
        double inverse0 = 0, inverse1 = 0;              ///< of their effects on themselves; 0: they have none
        double scale = 0;                               ///< of the inverse matrix; 0: the two press as one
        int spots = 0;
    };
    double slip(const Triple& free, double x, double y) const {
        return free[tangent] + effects_[tangent][0] * x + effects_[tangent][1] * y;
    }
    const Normals& sliding(bool forward);
    Triple slidingWanted(const Triple& free, bool forward);

    Point normal_;
    Triple leverOfA_{}, leverOfB_{};
    std::array<double, 2> wanted_{};
    std::array<Triple, 3> effects_{};
    double friction_;
    int spots_;
    double inverseTangent_ = 0;
    std::array<double, 2> borrowed_{};  ///< what sticking takes of a normal's free excess for each m/s of slip
    Normals sticking_;
    std::array<Normals, 2> sliding_;  ///< rubbing backward, forward; made when asked for
};

}  // namespace mrose
