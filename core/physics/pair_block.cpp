#include "physics/pair_block.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

// Two spots that act on each other so nearly as on themselves press as one.
constexpr double leastDeterminant = 1e-12;

double through(const RigidBody& body, double along, double lever, double other) {
    return body.inverseMass * along + body.inverseInertia * lever * other;
}

}  // namespace

PairBlock::PairBlock(const RigidBody& a, const RigidBody& b, const PressedPair& pair)
    : friction_(pair.friction), spots_(pair.count) {
    const auto set = [&](int i, const Point& axis, const PressedPair::Spot& spot, double wanted) {
        lines_[i] = {axis, cross(spot.armOfA, axis), cross(spot.armOfB, axis), wanted};
        effects_[i][i] = through(a, 1, lines_[i].leverOfA, lines_[i].leverOfA) +
                         through(b, 1, lines_[i].leverOfB, lines_[i].leverOfB);
    };
    const auto couple = [&](int i, int j, double along) {
        effects_[i][j] = effects_[j][i] = through(a, along, lines_[i].leverOfA, lines_[j].leverOfA) +
                                          through(b, along, lines_[i].leverOfB, lines_[j].leverOfB);
    };
    for (int i = 0; i < spots_; ++i) set(i, pair.normal, pair.spots[i], pair.spots[i].wanted);
    set(tangent, {-pair.normal.y, pair.normal.x}, pair.spots[pair.rubs], 0);
    for (int i = 0; i < spots_; ++i) couple(i, tangent, 0);
    if (spots_ == 2) couple(0, 1, 1);
    const auto& e = effects_;
    if (friction_ > 0) {
        inverseTangent_ = 1 / e[tangent][tangent];
        borrowed_ = {e[0][tangent] * inverseTangent_, e[1][tangent] * inverseTangent_};
    }
    sticking_.emplace(e[0][0] - borrowed_[0] * e[tangent][0], e[0][1] - borrowed_[0] * e[tangent][1],
                      e[1][0] - borrowed_[1] * e[tangent][0], e[1][1] - borrowed_[1] * e[tangent][1], spots_);
}

PairBlock::Triple PairBlock::excess(const RigidBody& a, const RigidBody& b) const {
    Triple excess{};
    const Point apart = b.velocity - a.velocity;
    const auto set = [&](int i) {
        const Line& line = lines_[i];
        excess[i] = dot(apart, line.axis) + b.rotation * line.leverOfB - a.rotation * line.leverOfA - line.wanted;
    };
    for (int i = 0; i < spots_; ++i) set(i);
    set(tangent);
    return excess;
}

PairBlock::Normals::Normals(double e00, double e01, double e10, double e11, int count)
    : on01(e01), on10(e10), inverse0(e00 > 0 ? 1 / e00 : 0), inverse1(0), scale(0), on00(e00), on11(e11), spots(count) {
    if (spots < 2) return;
    inverse1 = e11 > 0 ? 1 / e11 : 0;
    const double product = e00 * e11, determinant = product - e01 * e10;
    if (determinant > leastDeterminant * product) scale = 1 / determinant;
}

/// A linear complementarity problem of two, by its cases: the first alone, the second alone, both.
bool PairBlock::Normals::solve(double free0, double free1, double& x, double& y) const {
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

const PairBlock::Normals& PairBlock::sliding(bool forward) {
    std::optional<Normals>& normals = sliding_[forward ? 1 : 0];
    const double slope = forward ? friction_ : -friction_;
    const auto& e = effects_;
    if (!normals)
        normals.emplace(e[0][0] + slope * e[0][tangent], e[0][1] + slope * e[0][tangent],
                        e[1][0] + slope * e[1][tangent], e[1][1] + slope * e[1][tangent], spots_);
    return *normals;
}

PairBlock::Triple PairBlock::wanted(const Triple& free) {
    const auto& e = effects_;
    Triple found{};
    double &x = found[0], &y = found[1], &t = found[tangent];
    const auto slip = [&] { return free[tangent] + e[tangent][0] * x + e[tangent][1] * y; };
    if (sticking_->solve(free[0] - borrowed_[0] * free[tangent], free[1] - borrowed_[1] * free[tangent], x, y)) {
        t = -inverseTangent_ * slip();
        if (std::abs(t) <= friction_ * (x + y)) return found;
    }
    const bool forward = t > 0;
    for (const bool way : {forward, !forward}) {
        if (!sliding(way).solve(free[0], free[1], x, y)) continue;
        t = (way ? friction_ : -friction_) * (x + y);
        if (t * (slip() + e[tangent][tangent] * t) <= 0) return found;
    }
    // Both ways rubbing would hold itself (Painleve): then nothing rubs.
    Normals(e[0][0], e[0][1], e[1][0], e[1][1], spots_).solve(free[0], free[1], x, y);
    t = 0;
    return found;
}

void PairBlock::add(const Triple& impulses, double factor, Triple& excess) const {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) excess[i] += factor * effects_[j][i] * impulses[j];
}

void PairBlock::give(RigidBody& a, RigidBody& b, const Triple& impulses) const {
    Point impulse = impulses[tangent] * lines_[tangent].axis;
    double turnOfA = impulses[tangent] * lines_[tangent].leverOfA;
    double turnOfB = impulses[tangent] * lines_[tangent].leverOfB;
    for (int i = 0; i < spots_; ++i) {
        impulse = impulse + impulses[i] * lines_[i].axis;
        turnOfA += impulses[i] * lines_[i].leverOfA;
        turnOfB += impulses[i] * lines_[i].leverOfB;
    }
    a.push(-1 * impulse, -turnOfA);
    b.push(impulse, turnOfB);
}

}  // namespace mrose
