#include "physics/impulse_sweeps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrose {

ImpulseSweeps::Change ImpulseSweeps::sweep() {
    Change change;
    for (Member& member : members_) {
        PairBlock::Triple free = member.block.excess(member.a, member.b);
        member.block.add(member.impulses, -1, free);
        const PairBlock::Triple wanted = member.block.wanted(free);
        for (int i = 0; i < 3; ++i) {
            const double more = member.newest[i] = wanted[i] - member.impulses[i];
            change.square += more * more * member.block.effect(i, i);
            change.fastest = std::max(change.fastest, std::abs(more) * member.block.effect(i, i));
        }
        member.block.give(member.a, member.b, member.newest);
        member.impulses = wanted;
    }
    return change;
}

/// Goes on along the way that the sweeps went: `share` of it, and the newest sweep's change is the rest of the next.
void ImpulseSweeps::goOn(double share) {
    for (Member& member : members_) {
        PairBlock::Triple more;
        for (int i = 0; i < 3; ++i) {
            more[i] = share * member.way[i];
            member.impulses[i] += more[i];
            member.way[i] = more[i] + member.newest[i];
        }
        if (share > 0) member.block.give(member.a, member.b, more);
    }
}

bool ImpulseSweeps::find(std::span<RigidBody> bodies, std::span<PressedPair> pairs, int mostSweeps) {
    members_.clear();
    for (const PressedPair& pair : pairs) {
        RigidBody &a = bodies[pair.a], &b = bodies[pair.b];
        members_.push_back({PairBlock(a, b, pair), a, b, {pair.pressed[0], pair.pressed[1], pair.rubbed}});
    }
    for (const Member& member : members_) member.block.give(member.a, member.b, member.impulses);
    const bool settled = settle(mostSweeps);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const PairBlock::Triple& impulses = members_[i].impulses;
        pairs[i].pressed = {impulses[0], impulses[1]};
        pairs[i].rubbed = impulses[PairBlock::tangent];
    }
    return settled;
}

bool ImpulseSweeps::settle(int mostSweeps) {
    Change last{std::numeric_limits<double>::infinity(), 0};
    for (int i = 0; i < mostSweeps; ++i) {
        const Change change = sweep();
        // What shrinks by a share from sweep to sweep lacks a geometric series.
        const double share = std::min(1.0, change.fastest / last.fastest);
        if (i > 0 && change.fastest <= PairBlock::settled * (1 - share)) return true;
        if (change.fastest == 0) return true;
        if (i + 1 < mostSweeps) goOn(change.square < last.square ? change.square / last.square : 0);
        last = change;
    }
    return false;
}

}  // namespace mrose
