#include "physics/impulse_sweeps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrose {

ImpulseSweeps::Change ImpulseSweeps::sweep(std::span<RigidBody> bodies) {
    Change change;
    for (Member& member : members_) {
        RigidBody &a = bodies[member.a], &b = bodies[member.b];
        PairBlock::Triple free = member.block.excess(a, b);
        member.block.add(member.impulses, -1, free);
        const PairBlock::Triple wanted = member.block.wanted(free);
        for (int i = 0; i < 3; ++i) {
            const double more = member.newest[i] = wanted[i] - member.impulses[i];
            const double faster = std::abs(more) * member.block.effect(i, i);
            change.square += std::abs(more) * faster;
            change.fastest = std::max(change.fastest, faster);
        }
        member.block.give(a, b, member.newest);
        member.impulses = wanted;
    }
    return change;
}

/// Goes on along the way that the sweeps went: `share` of it, and the newest sweep's change is the rest of the next.
void ImpulseSweeps::goOn(std::span<RigidBody> bodies, double share) {
    const auto go = [&](double& value, double& way, double newest) {
        way *= share;
        value += way;
        way += newest;
    };
    for (Member& member : members_)
        for (int i = 0; i < 3; ++i) go(member.impulses[i], member.way[i], member.newest[i]);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        RigidBody& body = bodies[i];
        Way& way = ways_[i];
        const Point newest = body.velocity - way.velocityBefore;
        go(body.velocity.x, way.velocity.x, newest.x);
        go(body.velocity.y, way.velocity.y, newest.y);
        go(body.rotation, way.rotation, body.rotation - way.rotationBefore);
        way.velocityBefore = body.velocity;
        way.rotationBefore = body.rotation;
    }
}

bool ImpulseSweeps::find(std::span<RigidBody> bodies, std::span<PressedPair> pairs, int mostSweeps) {
    members_.clear();
    for (const PressedPair& pair : pairs) {
        RigidBody &a = bodies[pair.a], &b = bodies[pair.b];
        members_.push_back({PairBlock(a, b, pair), pair.a, pair.b, {pair.pressed[0], pair.pressed[1], pair.rubbed}});
        members_.back().block.give(a, b, members_.back().impulses);
    }
    ways_.clear();
    for (const RigidBody& body : bodies) ways_.push_back({{}, 0, body.velocity, body.rotation});
    const bool settled = settle(bodies, mostSweeps);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const PairBlock::Triple& impulses = members_[i].impulses;
        pairs[i].pressed = {impulses[0], impulses[1]};
        pairs[i].rubbed = impulses[PairBlock::tangent];
    }
    return settled;
}

bool ImpulseSweeps::settle(std::span<RigidBody> bodies, int mostSweeps) {
    Change last{std::numeric_limits<double>::infinity(), 0};
    for (int i = 0; i < mostSweeps; ++i) {
        const Change change = sweep(bodies);
        // What shrinks by a share from sweep to sweep lacks a geometric series.
        const double share = std::min(1.0, change.fastest / last.fastest);
        if (i > 0 && change.fastest <= PairBlock::settled * (1 - share)) return true;
        if (change.fastest == 0) return true;
        if (i + 1 < mostSweeps) goOn(bodies, change.square < last.square ? change.square / last.square : 0);
        last = change;
    }
    return false;
}

}  // namespace mrose
