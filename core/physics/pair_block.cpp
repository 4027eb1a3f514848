#include "physics/pair_block.h"

namespace mrose {
namespace {

// Two spots that act on each other so nearly as on themselves press as one.
constexpr double leastDeterminant = 1e-12;

}  // namespace

PairBlock::PairBlock(const RigidBody& a, const RigidBody& b, const PressedPair& pair)
    : normal_(pair.normal), friction_(pair.friction), spots_(pair.count) {
    for (int i = 0; i < spots_; ++i) {
        leverOfA_[i] = cross(pair.spots[i].armOfA, normal_);
        leverOfB_[i] = cross(pair.spots[i].armOfB, normal_);
        wanted_[i] = pair.spots[i].wanted;
    }
    leverOfA_[tangent] = dot(pair.spots[pair.rubs].armOfA, normal_);
    leverOfB_[tangent] = dot(pair.spots[pair.rubs].armOfB, normal_);
    const auto couple = [&](int i, int j, double along) {
        effects_[i][j] = effects_[j][i] = (a.inverseMass + b.inverseMass) * along +
                                          a.inverseInertia * leverOfA_[i] * leverOfA_[j] +
                                          b.inverseInertia * leverOfB_[i] * leverOfB_[j];
    };
    couple(0, 0, 1);
    couple(0, tangent, 0);
    couple(tangent, tangent, 1);
    if (spots_ == 2) {
        couple(0, 1, 1);
        couple(1, 1, 1);
        couple(1, tangent, 0);
    }
    const auto& e = effects_;
    if (friction_ > 0) {
        inverseTangent_ = 1 / e[tangent][tangent];
        borrowed_ = {e[0][tangent] * inverseTangent_, e[1][tangent] * inverseTangent_};
    }
    sticking_ = {e[0][0] - borrowed_[0] * e[tangent][0], e[0][1] - borrowed_[0] * e[tangent][1],
                 e[1][0] - borrowed_[1] * e[tangent][0], e[1][1] - borrowed_[1] * e[tangent][1], spots_};
}

PairBlock::Normals::Normals(double e00, double e01, double e10, double e11, int count)
    : on00(e00), on01(e01), on10(e10), on11(e11), inverse0(e00 > 0 ? 1 / e00 : 0), spots(count) {
    if (spots < 2) return;
    inverse1 = e11 > 0 ? 1 / e11 : 0;
    const double product = e00 * e11, determinant = product - e01 * e10;
    if (determinant > leastDeterminant * product) scale = 1 / determinant;
}

const PairBlock::Normals& PairBlock::sliding(bool forward) {
    Normals& normals = sliding_[forward ? 1 : 0];
    const double slope = forward ? friction_ : -friction_;
    const auto& e = effects_;
    if (normals.spots == 0)
        normals = {e[0][0] + slope * e[0][tangent], e[0][1] + slope * e[0][tangent], e[1][0] + slope * e[1][tangent],
                   e[1][1] + slope * e[1][tangent], spots_};
    return normals;
}

/// Sliding first the way that sticking would have to be held back.
PairBlock::Triple PairBlock::slidingWanted(const Triple& free, bool forward) {
    double x = 0, y = 0;
    for (const bool way : {forward, !forward}) {
        if (!sliding(way).solve(free[0], free[1], x, y)) continue;
        const double t = (way ? friction_ : -friction_) * (x + y);
        if (t * (slip(free, x, y) + effects_[tangent][tangent] * t) <= 0) return {x, y, t};
    }
    // Both ways rubbing would hold itself (Painleve): then nothing rubs.
    const auto& e = effects_;
    Normals(e[0][0], e[0][1], e[1][0], e[1][1], spots_).solve(free[0], free[1], x, y);
    return {x, y, 0};
}

}  // namespace mrose
