#include "physics/exact_impulses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mrose {
namespace {

constexpr int mostRounds = 8;
// A sweep that changes but this share of what the one before did has got quickly nearer.
constexpr double quickly = 0.1;
// A sweep that changes no velocity by more has found all right, m/s.
constexpr double exactlySettled = 1e-6;
// Less than this share of its effect on itself is left of an impulse that others can replace.
constexpr double redundant = 1e-9;

void findOne(std::span<RigidBody> bodies, PressedPair& pair) {
    RigidBody &a = bodies[pair.a], &b = bodies[pair.b];
    PairBlock block(a, b, pair);
    const PairBlock::Triple impulses = block.wanted(block.excess(a, b));
    block.give(a, b, impulses);
    pair.pressed = {impulses[0], impulses[1]};
    pair.rubbed = impulses[PairBlock::tangent];
}

}  // namespace

bool ExactImpulses::find(std::span<RigidBody> bodies, std::span<PressedPair> pairs) {
    if (pairs.size() == 1) {
        findOne(bodies, pairs.front());
        return true;
    }
    setUp(bodies, pairs);
    const bool settled = settle();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Member& member = members_[i];
        PairBlock::Triple impulses{};
        for (int k = 0; k < member.block.spots(); ++k) impulses[k] = impulses_[member.first + k];
        impulses[PairBlock::tangent] = impulses_[member.tangent()];
        if (settled) member.block.give(bodies[pairs[i].a], bodies[pairs[i].b], impulses);
        pairs[i].pressed = {impulses[0], impulses[1]};
        pairs[i].rubbed = impulses[PairBlock::tangent];
    }
    return settled;
}

bool ExactImpulses::settle() {
    double last = std::numeric_limits<double>::infinity();
    bool linear = false;  // the last sweep's start solves for who pressed and slid then
    for (int i = 0; i < mostRounds; ++i) {
        const double change = sweep();
        if (change <= (linear ? PairBlock::settled : exactlySettled)) return true;
        // As long as sweeps alone get quickly nearer there is no need of more.
        linear = i >= 2 && (i == 2 || change > quickly * last);
        if (linear) newtonSteps();
        last = change;
    }
    return false;
}

void ExactImpulses::setUp(std::span<const RigidBody> bodies, std::span<const PressedPair> pairs) {
    members_.clear();
    lines_.clear();
    excess_.clear();
    begin_.clear();
    for (const PressedPair& pair : pairs) {
        const RigidBody &a = bodies[pair.a], &b = bodies[pair.b];
        const int first = static_cast<int>(lines_.size());
        const PairBlock& block = members_.emplace_back(Member{PairBlock(a, b, pair), first}).block;
        const PairBlock::Triple excess = block.excess(a, b);
        const auto addLine = [&](int i, double impulse) {
            lines_.push_back({block.line(i), i == PairBlock::tangent});
            excess_.push_back(excess[i]);
            begin_.push_back(impulse);
        };
        for (int i = 0; i < pair.count; ++i) addLine(i, pair.pressed[i]);
        addLine(PairBlock::tangent, pair.rubbed);
    }
    effects_.assign(lines_.size() * lines_.size(), 0);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const PressedPair &p = pairs[i], &q = pairs[j];
            if (p.a == q.a) couple(bodies[p.a], members_[i], false, members_[j], false);
            if (p.b == q.b) couple(bodies[p.b], members_[i], true, members_[j], true);
            if (p.a == q.b) couple(bodies[p.a], members_[i], false, members_[j], true);
            if (p.b == q.a) couple(bodies[p.b], members_[i], true, members_[j], false);
        }
        const Member& own = members_[i];
        const int spots = own.block.spots();
        for (int k = 0; k <= spots; ++k)
            for (int l = 0; l <= spots; ++l)
                effectsOf(own.first + k)[own.first + l] =
                    own.block.effect(k < spots ? k : PairBlock::tangent, l < spots ? l : PairBlock::tangent);
    }
    impulses_.assign(lines_.size(), 0);
    for (int i = 0; i < static_cast<int>(lines_.size()); ++i)
        if (begin_[i] != 0) add(i, begin_[i]);
}

/// What two pairs do to each other through a body, which is the second of the one or the other or not.
void ExactImpulses::couple(const RigidBody& body, const Member& one, bool second, const Member& other, bool ofOther) {
    if (body.inverseMass == 0) return;
    const double sign = second == ofOther ? 1 : -1;
    for (int i = one.first; i <= one.tangent(); ++i)
        for (int j = other.first; j <= other.tangent(); ++j) {
            const PairBlock::Line &felt = lines_[i].of, &cause = lines_[j].of;
            const double turns = (second ? felt.leverOfB : felt.leverOfA) * (ofOther ? cause.leverOfB : cause.leverOfA);
            const double effect = sign * (body.inverseMass * dot(felt.axis, cause.axis) + body.inverseInertia * turns);
            effectsOf(i)[j] += effect;
            effectsOf(j)[i] += effect;
        }
}

void ExactImpulses::add(int line, double impulse) {
    impulses_[line] += impulse;
    const double* const effects = effectsOf(line);
    double* const excess = excess_.data();
    for (std::size_t i = 0; i < excess_.size(); ++i) excess[i] += impulse * effects[i];
}

/// The fastest change of a spot's velocity, m/s.
double ExactImpulses::sweep() {
    double fastest = 0;
    for (Member& member : members_) {
        const int count = member.block.spots() + 1;
        const auto placeOf = [&](int i) { return i + 1 < count ? i : PairBlock::tangent; };
        PairBlock::Triple has{}, free{};
        for (int i = 0; i < count; ++i) {
            has[placeOf(i)] = impulses_[member.first + i];
            free[placeOf(i)] = excess_[member.first + i];
        }
        member.block.add(has, -1, free);
        const PairBlock::Triple wanted = member.block.wanted(free);
        for (int i = 0; i < count; ++i) {
            const int k = placeOf(i);
            if (wanted[k] == has[k]) continue;
            fastest = std::max(fastest, std::abs(wanted[k] - has[k]) * member.block.effect(k, k));
            add(member.first + i, wanted[k] - has[k]);
            impulses_[member.first + i] = wanted[k];
        }
    }
    return fastest;
}

/// On the way to where all would be right nobody may come to pull: who would is left out, and the rest goes on without
/// (as Lawson and Hanson 1974 solve least squares that must not be negative).
void ExactImpulses::newtonSteps() {
    while (!newtonStep()) {
    }
}

/// Who presses goes on pressing, who sticks sticks, who slides rubs by what it presses: then the rest is linear.
bool ExactImpulses::newtonStep() {
    findUnknowns();
    solveUnknowns();
    double share = 1;
    int pulls = -1;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
        const Line& line = lines_[unknowns_[i].line];
        const double impulse = impulses_[unknowns_[i].line];
        if (line.rubs || impulse >= share * -more_[i]) continue;
        share = impulse / -more_[i];
        pulls = unknowns_[i].line;
    }
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
        add(unknowns_[i].line, share * more_[i]);
        if (unknowns_[i].slides != 0) add(unknowns_[i].tangent, unknowns_[i].slides * share * more_[i]);
    }
    if (pulls < 0) return true;
    add(pulls, -impulses_[pulls]);
    impulses_[pulls] = 0;
    return false;
}

void ExactImpulses::findUnknowns() {
    unknowns_.clear();
    for (const Member& member : members_) {
        const int tangent = member.tangent();
        double pressed = 0;
        for (int i = member.first; i < tangent; ++i) pressed += impulses_[i];
        if (pressed <= 0) continue;
        const double rubbed = impulses_[tangent], friction = member.block.friction();
        const bool sticks = std::abs(rubbed) < friction * pressed;
        for (int i = member.first; i < tangent; ++i)
            if (impulses_[i] > 0) unknowns_.push_back({i, tangent, sticks ? 0 : std::copysign(friction, rubbed)});
        if (sticks) unknowns_.push_back({tangent, tangent, 0});
    }
}

/// Gauss's elimination, into more_. What others can do as well stays as it is.
void ExactImpulses::solveUnknowns() {
    const std::size_t count = unknowns_.size(), width = count + 1;
    equations_.resize(count * width);
    more_.resize(count);
    const auto row = [&](std::size_t i) { return &equations_[i * width]; };
    for (std::size_t j = 0; j < count; ++j) {
        const auto [line, tangent, slides] = unknowns_[j];
        const double *const effects = effectsOf(line), *const sideways = effectsOf(tangent);
        double* entry = &equations_[j];
        for (std::size_t i = 0; i < count; ++i, entry += width) *entry = effects[unknowns_[i].line];
        if (slides != 0)
            for (std::size_t i = 0; i < count; ++i) row(i)[j] += slides * sideways[unknowns_[i].line];
        row(j)[count] = -excess_[line];
        more_[j] = redundant * row(j)[j];
    }
    for (std::size_t k = 0; k < count; ++k) {
        const double* const from = row(k);
        if (!(from[k] > more_[k])) {
            row(k)[k] = 0;
            continue;
        }
        const double inverse = 1 / from[k];
        for (std::size_t i = k + 1; i < count; ++i) {
            double* const into = row(i);
            if (into[k] == 0) continue;
            const double factor = into[k] * inverse;
            for (std::size_t j = k + 1; j < width; ++j) into[j] -= factor * from[j];
        }
    }
    for (std::size_t k = count; k-- > 0;) {
        const double pivot = row(k)[k];
        more_[k] = 0;
        if (pivot == 0) continue;
        double rest = row(k)[count];
        for (std::size_t j = k + 1; j < count; ++j) rest -= row(k)[j] * more_[j];
        more_[k] = rest / pivot;
    }
}

}  // namespace mrose
