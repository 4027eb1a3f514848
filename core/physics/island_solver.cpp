#include "physics/island_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/energy.h"
#include "physics/first_touches.h"

namespace mrose {
namespace {

// A pair that has bounced so often in a tick presses from then on.
constexpr int mostBounces = 8;
// Where so many pairs have been solved for in a tick, all that would still touch press from the next touch on.
constexpr std::size_t mostEffort = 64;

/// The search begins with what they pressed in the last tick.
void warm(PressedPair& pair, const Meeting& meeting) {
    for (const ContactImpulse& impulse : meeting.kept)
        for (int i = 0; i < pair.count; ++i)
            if (meeting.touch.spots[i].which == impulse.feature) {
                pair.pressed[i] = impulse.normal;
                pair.rubbed += impulse.tangent;
            }
}

bool mayBounce(const Meeting& meeting, const Meeting* arriving) {
    return (arriving == nullptr || &meeting == arriving) && meeting.state == Meeting::State::apart && !meeting.leant &&
           meeting.restitution > 0 && meeting.bounces < mostBounces;
}

}  // namespace

void IslandSolver::solveAtStart(ClusterInTick& cluster, std::uint32_t island) {
    cluster_ = &cluster;
    gatherBodies(0, island);
    for (Meeting& meeting : cluster.meetings)
        if (meeting.touches && cluster.islands.of(meeting.a) == island) addPair(meeting, 0, nullptr);
    if (pairs_.empty()) return;
    solve();
    keepStart();
    countImpulses();
    moveBodies();
}

void IslandSolver::solveAt(ClusterInTick& cluster, double time, std::uint32_t island, Meeting& arriving,
                           std::vector<Meeting*>& changed) {
    cluster_ = &cluster;
    changed.clear();
    gatherBodies(time, island);
    const bool crowded = cluster.islands.effort(island) > mostEffort;
    for (Meeting& meeting : cluster.meetings) {
        if (cluster.islands.of(meeting.a) != island) continue;
        if (crowded && meeting.next != never && (meeting.grounded() || cluster.islands.of(meeting.b) == island))
            meeting.state = Meeting::State::pressing;
        if (meeting.state == Meeting::State::pressing || &meeting == &arriving) addPair(meeting, time, &arriving);
    }
    if (!pairs_.empty()) {
        cluster.islands.addEffort(island, pairs_.size());
        solve();
        countImpulses();
        moveBodies();
    }
    for (Meeting& meeting : cluster.meetings)
        if (&meeting == &arriving || moved(meeting.a) || (!meeting.grounded() && moved(meeting.b)))
            changed.push_back(&meeting);
}

void IslandSolver::gatherBodies(double time, std::uint32_t island) {
    members_.clear();
    rigid_.clear();
    pairs_.clear();
    pairOf_.clear();
    bounces_.clear();
    place_.resize(cluster_->bodies.size());
    for (std::uint32_t i = island; i < cluster_->bodies.size(); ++i) {
        if (cluster_->islands.of(i) != island) continue;
        place_[i] = static_cast<std::uint32_t>(members_.size());
        members_.push_back(i);
        MovingBody& body = cluster_->bodies[i];
        body.advance(time);
        rigid_.push_back({body.inverseMass, body.inverseInertia, body.velocity, body.rotation});
    }
    rigid_.emplace_back();
    rigidBefore_.assign(rigid_.begin(), rigid_.end());
}

/// Adds what is to be solved for of a pair that presses or bounces at a time.
void IslandSolver::addPair(Meeting& meeting, double time, const Meeting* arriving) {
    const bool starts = arriving == nullptr;
    if (!starts) {
        const ConvexPiece one = placedAt(cluster_->pieceA(meeting), time);
        const ConvexPiece other = placedAt(cluster_->pieceB(meeting), time);
        meeting.gap = gapBetween(one, other);
        meeting.touch = findTouch(one, other, meeting.gap);
    }
    if (&meeting == arriving && meeting.state == Meeting::State::pressing) ++meeting.sinkings;
    PressedPair& pair = pairs_.emplace_back();
    pair.a = place_[meeting.a];
    pair.b = meeting.grounded() ? static_cast<std::uint32_t>(members_.size()) : place_[meeting.b];
    pair.normal = meeting.touch.normal;
    pair.friction = meeting.friction;
    const bool bounces = choosePoints(meeting, cluster_->tick->duration - time, mayBounce(meeting, arriving), pair);
    meeting.state = bounces ? Meeting::State::apart : Meeting::State::pressing;
    if (pair.count == 0) {
        pairs_.pop_back();
        return;
    }
    if (starts) warm(pair, meeting);
    pairOf_.push_back(&meeting);
    bounces_.push_back(bounces);
}

/// The spots at which the pair presses on each other, `left` seconds before the tick's end, or bounces, if it may:
/// which of the two. The meeting's touch is without others then. A spot that is apart by d may approach at d / left,
/// and then just touches when the tick ends; one that bounces parts at its restitution times the speed of its approach.
bool IslandSolver::choosePoints(Meeting& meeting, double left, bool mayBounce, PressedPair& pair) const {
    Touch& touch = meeting.touch;
    const auto apart = [&](int i) { return touch.spots[i].distance - touchDistance; };
    std::array<double, 2> parts{};
    bool bounces = false;
    for (int i = 0; i < touch.count; ++i) {
        parts[i] = cluster_->partingAt(meeting, touch.spots[i].position, touch.normal);
        bounces = bounces || (mayBounce && apart(i) <= touchSlack && parts[i] < -bounceThreshold);
    }
    for (int i = 0; i < touch.count; ++i) {
        double wanted = 0;
        if (apart(i) > 0) {
            // Who bounces is looked at again; else this one must not sink in either before the tick's end.
            if (apart(i) > touchSlack && (bounces || left <= 0)) continue;
            wanted = left > 0 ? -apart(i) / left : 0;
        }
        if (bounces) wanted = std::max(0.0, -meeting.restitution * parts[i]);
        const Point& position = touch.spots[i].position;
        const Point armOfB = meeting.grounded() ? Point{} : position - cluster_->bodies[meeting.b].centre;
        pair.spots[pair.count] = {position - cluster_->bodies[meeting.a].centre, armOfB, wanted};
        touch.spots[pair.count++] = touch.spots[i];
    }
    touch.count = pair.count;
    if (pair.count == 2 && std::abs(touch.spots[1].distance) < std::abs(touch.spots[0].distance)) pair.rubs = 1;
    return bounces;
}

/// The impulses, and less motion where they would leave more energy than there was.
void IslandSolver::solve() {
    findImpulses();
    bool grounded = false;
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        grounded = grounded || (pairOf_[i]->grounded() && pairs_[i].pressed[0] + pairs_[i].pressed[1] > 0);
    takeBackEnergy(rigidBefore_, rigid_, grounded);
}

void IslandSolver::findImpulses() {
    constexpr int soon = 24, mostOfFew = 40, mostOfHeap = 400;
    if (pairs_.size() > ExactImpulses::mostPairs) {
        sweeps_.find(rigid_, pairs_, mostOfHeap);
        return;
    }
    if (pairs_.size() > 1 && sweeps_.find(rigid_, pairs_, soon)) return;
    // Where masses are unequal sweeps hardly get on.
    rigid_.assign(rigidBefore_.begin(), rigidBefore_.end());
    if (!exact_.find(rigid_, pairs_)) sweeps_.find(rigid_, pairs_, mostOfFew);
}

/// What presses when the tick begins: the next tick's search starts from it.
void IslandSolver::keepStart() {
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const PressedPair& pair = pairs_[i];
        Meeting& meeting = *pairOf_[i];
        double rubbed = pair.rubbed;
        for (int k = 0; k < pair.count; ++k) {
            if (bounces_[i] || pair.pressed[k] <= 0) continue;
            ContactImpulse& kept = meeting.atStart[meeting.startCount++];
            kept.feature = meeting.touch.spots[k].which;
            kept.normal = static_cast<float>(pair.pressed[k]);
            kept.tangent = static_cast<float>(std::exchange(rubbed, 0));
        }
    }
}

void IslandSolver::countImpulses() {
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        double sum = 0;
        for (int k = 0; k < pairs_[i].count; ++k) sum += pairs_[i].pressed[k];
        pairOf_[i]->impulse += sum;
        if (bounces_[i]) ++pairOf_[i]->bounces;
    }
}

void IslandSolver::moveBodies() {
    for (std::size_t i = 0; i < members_.size(); ++i) {
        MovingBody& body = cluster_->bodies[members_[i]];
        if (body.velocity == rigid_[i].velocity && body.rotation == rigid_[i].rotation) continue;
        body.velocity = rigid_[i].velocity;
        body.rotation = rigid_[i].rotation;
        body.pushed = true;
        body.known = -1;
    }
}

/// Whether a body is of the island and was given another motion.
bool IslandSolver::moved(std::uint32_t body) const {
    if (place_[body] >= members_.size() || members_[place_[body]] != body) return false;
    const RigidBody &now = rigid_[place_[body]], &then = rigidBefore_[place_[body]];
    return !(now.velocity == then.velocity) || now.rotation != then.rotation;
}

}  // namespace mrose
