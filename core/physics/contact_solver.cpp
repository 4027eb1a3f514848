#include "physics/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "physics/kept_impulses.h"
#include "physics/overlaps.h"

namespace mrose {
namespace {

// Slower than this bounces are dead, m/s.
constexpr double bounceThreshold = 0.05;
// A pair that has bounced so often in a tick presses from then on.
constexpr int mostBounces = 8;
// A pair that presses and would sink in deeper is looked at again before it has by so much, m, and so often in a tick.
constexpr double deepest = 5e-4, deep = 2.5e-4;
constexpr int mostSinkings = 64;
// And when the two have turned by so much against each other, rad.
constexpr double largestTurn = 0.2;
// Where so many pairs have been solved for in a tick, all that would still touch press from the next touch on.
constexpr std::size_t mostEffort = 64;
// Slower than this a pressing pair does not part, m/s.
constexpr double partingSpeed = 1e-3;

/// Whether the two pressed on each other before, with the other one first then.
bool leantTurned(const ContactImpulse& key, std::span<const ContactImpulse> before) {
    return key.bodyB != noBody && !impulsesOf({key.bodyB, key.pieceB, key.bodyA, key.pieceA}, before).empty();
}

/// The search begins with what they pressed in the last tick.
void warm(PressedPair& pair, const Meeting& meeting) {
    for (const ContactImpulse& impulse : meeting.kept)
        for (int i = 0; i < pair.count; ++i)
            if (meeting.touch.spots[i].which == impulse.feature) {
                pair.pressed[i] = impulse.normal;
                pair.rubbed += impulse.tangent;
            }
}

}  // namespace

void ContactSolver::solve(const ContactTick& tick, const ContactCluster& cluster,
                          std::span<const ContactImpulse> before, std::vector<ContactImpulse>& after,
                          std::span<ContactOutcome> outcomes, std::vector<ContactReport>* reports) {
    tick_ = &tick;
    cluster_ = &cluster;
    bodies_.clear();
    for (const ContactBody& body : cluster.bodies) bodies_.emplace_back(body, tick.duration);
    findMeetings(tick, cluster, meetings_);
    startTouching(before);
    goThroughTick();
    pressOut(bodies_, meetings_, tick.duration);
    for (const Meeting& meeting : meetings_) {
        if (meeting.state == Meeting::State::pressing && meeting.impulse > 0 && !parting(meeting))
            keepImpulses(keyOf(cluster, meeting), meeting, after);
        const bool touching =
            meeting.state == Meeting::State::pressing && meeting.gap.distance <= touchDistance + touchSlack;
        if (reports != nullptr && (meeting.impulse > 0 || touching)) report(meeting, *reports);
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) outcomes[i] = outcomeOf(bodies_[i]);
}

std::uint32_t ContactSolver::islandOf(std::uint32_t body) {
    while (island_[body] != body) body = island_[body] = island_[island_[body]];
    return body;
}

/// Makes the islands of a pair's bodies one.
void ContactSolver::join(const Meeting& meeting) {
    const auto [least, other] = std::minmax({islandOf(meeting.a), islandOf(meeting.b)});
    if (least == other) return;
    island_[other] = least;
    effort_[least] += effort_[other];
}

/// Whether two that do not touch yet will in this tick, and will not bounce: then they may press from its start on, by
/// so much that they just touch when it ends.
bool ContactSolver::comesToPress(const Meeting& meeting) const {
    const double approach = -partingAt(meeting, meeting.gap.at, meeting.gap.axis);
    if (approach >= bounceThreshold && !meeting.leant) return false;
    if (meeting.gap.distance - touchDistance >= approach * tick_->duration) return false;
    return timeOfTouch(pieceA(meeting), pieceB(meeting), meeting.gap, 0, tick_->duration) != never;
}

/// What touches when the tick begins, or comes to press on each other without a bounce.
void ContactSolver::startTouching(std::span<const ContactImpulse> before) {
    island_.resize(bodies_.size());
    std::iota(island_.begin(), island_.end(), 0);
    effort_.assign(bodies_.size(), 0);
    touching_.assign(bodies_.size(), 0);
    for (Meeting& meeting : meetings_) {
        const ContactImpulse key = keyOf(*cluster_, meeting);
        meeting.kept = impulsesOf(key, before);
        meeting.leant = !meeting.kept.empty() || leantTurned(key, before);
        meeting.far = !meeting.leant && tooFar(pieceA(meeting), pieceB(meeting), 0, tick_->duration);
        if (meeting.far) continue;
        const ConvexPiece& a = bodies_[meeting.a].body->pieces[meeting.pieceA];
        const ConvexPiece& b =
            meeting.grounded() ? meeting.outlineB->outline : bodies_[meeting.b].body->pieces[meeting.pieceB];
        meeting.gap = gapBetween(a, b);
        if (meeting.gap.distance > touchDistance + touchSlack && !comesToPress(meeting)) continue;
        meeting.touch = findTouch(a, b, meeting.gap);
        meeting.touches = true;
        touching_[meeting.a] = 1;
        if (!meeting.grounded()) join(meeting);
    }
    for (std::uint32_t i = 0; i < bodies_.size(); ++i)
        if (touching_[i] != 0) touching_[islandOf(i)] = 1;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i)
        if (touching_[i] != 0 && islandOf(i) == i) touchAt(0, i, nullptr);
}

/// From touch to touch, in the order of time.
void ContactSolver::goThroughTick() {
    for (Meeting& meeting : meetings_) lookAhead(meeting, 0);
    while (true) {
        Meeting* first = nullptr;
        for (Meeting& meeting : meetings_)
            if (meeting.next < (first != nullptr ? first->next : never)) first = &meeting;
        if (first == nullptr) return;
        if (!first->grounded()) join(*first);
        touchAt(first->next, islandOf(first->a), first);
    }
}

/// Solves for all that presses in an island at a time, and for the pair that arrives there then.
void ContactSolver::touchAt(double time, std::uint32_t island, Meeting* arriving) {
    members_.clear();
    pairs_.clear();
    pairOf_.clear();
    bounces_.clear();
    place_.resize(bodies_.size());
    rigid_.clear();
    for (std::uint32_t i = island; i < bodies_.size(); ++i) {
        if (islandOf(i) != island) continue;
        place_[i] = static_cast<std::uint32_t>(members_.size());
        members_.push_back(i);
        MovingBody& body = bodies_[i];
        body.advance(time);
        rigid_.push_back({body.inverseMass, body.inverseInertia, body.velocity, body.rotation});
    }
    rigid_.emplace_back();
    const bool crowded = effort_[island] > mostEffort;
    for (Meeting& meeting : meetings_) {
        if (islandOf(meeting.a) != island) continue;
        if (crowded && meeting.next != never && (meeting.grounded() || islandOf(meeting.b) == island))
            meeting.state = Meeting::State::pressing;
        if (meeting.state == Meeting::State::pressing || &meeting == arriving ||
            (arriving == nullptr && meeting.touches))
            addPair(meeting, time, arriving);
    }
    if (pairs_.empty()) return;
    if (arriving != nullptr) effort_[island] += pairs_.size();
    rigidBefore_.assign(rigid_.begin(), rigid_.end());
    findImpulses();
    collectSolution(time, arriving);
}

void ContactSolver::findImpulses() {
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

bool ContactSolver::mayBounce(const Meeting& meeting, const Meeting* arriving) const {
    return (arriving == nullptr || &meeting == arriving) && meeting.state == Meeting::State::apart && !meeting.leant &&
           meeting.restitution > 0 && meeting.bounces < mostBounces;
}

/// Adds what is to be solved for of a pair that presses or bounces at a time.
void ContactSolver::addPair(Meeting& meeting, double time, const Meeting* arriving) {
    const bool starts = arriving == nullptr;
    if (!starts) {
        const ConvexPiece one = placedAt(pieceA(meeting), time), other = placedAt(pieceB(meeting), time);
        meeting.gap = gapBetween(one, other);
        meeting.touch = findTouch(one, other, meeting.gap);
    }
    if (&meeting == arriving && meeting.state == Meeting::State::pressing) ++meeting.sinkings;
    PressedPair& pair = pairs_.emplace_back();
    pair.a = place_[meeting.a];
    pair.b = meeting.grounded() ? static_cast<std::uint32_t>(members_.size()) : place_[meeting.b];
    pair.normal = meeting.touch.normal;
    pair.friction = meeting.friction;
    const bool bounces = addSpots(meeting, tick_->duration - time, mayBounce(meeting, arriving), pair);
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
/// which of the two. The meeting's touch is without others then.
bool ContactSolver::addSpots(Meeting& meeting, double left, bool mayBounce, PressedPair& pair) const {
    Touch& touch = meeting.touch;
    const auto apart = [&](int i) { return touch.spots[i].distance - touchDistance; };
    std::array<double, 2> parts{};
    bool bounces = false;
    for (int i = 0; i < touch.count; ++i) {
        parts[i] = partingAt(meeting, touch.spots[i].position, touch.normal);
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
        const Point armOfB = meeting.grounded() ? Point{} : position - bodies_[meeting.b].centre;
        pair.spots[pair.count] = {position - bodies_[meeting.a].centre, armOfB, wanted};
        touch.spots[pair.count++] = touch.spots[i];
    }
    touch.count = pair.count;
    if (pair.count == 2 && std::abs(touch.spots[1].distance) < std::abs(touch.spots[0].distance)) pair.rubs = 1;
    return bounces;
}

void ContactSolver::collectSolution(double time, const Meeting* arriving) {
    bool grounded = false;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const PressedPair& pair = pairs_[i];
        Meeting& meeting = *pairOf_[i];
        double sum = 0, rubbed = pair.rubbed;
        for (int k = 0; k < pair.count; ++k) {
            sum += pair.pressed[k];
            if (arriving != nullptr || bounces_[i] || pair.pressed[k] <= 0) continue;
            ContactImpulse& kept = meeting.atStart[meeting.startCount++];
            kept.feature = meeting.touch.spots[k].which;
            kept.normal = static_cast<float>(pair.pressed[k]);
            kept.tangent = static_cast<float>(std::exchange(rubbed, 0));
        }
        meeting.impulse += sum;
        if (bounces_[i]) ++meeting.bounces;
        grounded = grounded || (sum > 0 && meeting.grounded());
    }
    takeBackEnergy(rigidBefore_, rigid_, grounded);
    for (std::size_t i = 0; i < members_.size(); ++i) {
        MovingBody& body = bodies_[members_[i]];
        if (body.velocity == rigid_[i].velocity && body.rotation == rigid_[i].rotation) continue;
        body.velocity = rigid_[i].velocity;
        body.rotation = rigid_[i].rotation;
        body.pushed = true;
        body.known = -1;
    }
    if (arriving == nullptr) return;
    const auto changed = [&](std::uint32_t body) {
        if (place_[body] >= members_.size() || members_[place_[body]] != body) return false;
        const RigidBody &now = rigid_[place_[body]], &then = rigidBefore_[place_[body]];
        return !(now.velocity == then.velocity) || now.rotation != then.rotation;
    };
    for (Meeting& meeting : meetings_)
        if (&meeting == arriving || changed(meeting.a) || (!meeting.grounded() && changed(meeting.b)))
            lookAhead(meeting, time);
}

void ContactSolver::lookAhead(Meeting& meeting, double time) {
    const double end = tick_->duration;
    const MovingPiece a = pieceA(meeting), b = pieceB(meeting);
    meeting.next = never;
    if (meeting.state == Meeting::State::apart && tooFar(a, b, time, end)) return;
    bodies_[meeting.a].know(end);
    if (!meeting.grounded()) bodies_[meeting.b].know(end);
    if (meeting.state == Meeting::State::apart) {
        const bool known = time == 0 && !meeting.far;
        meeting.next = timeOfTouch(a, b, known ? meeting.gap : gapAt(a, b, time), time, end);
        return;
    }
    // Where they touch they do not approach; they sink in by turning and sliding round each other, with time's square.
    const double now = std::min(meeting.gap.distance, touchDistance);
    const double turning =
        std::abs(bodies_[meeting.a].rotation - (meeting.grounded() ? 0 : bodies_[meeting.b].rotation));
    const double until = turning * (end - time) > largestTurn ? time + largestTurn / turning : end;
    meeting.atEnd = distanceLater(a, b, meeting.gap, time, until, now - deep);
    const double sinks = now - meeting.atEnd;
    if (meeting.sinkings >= mostSinkings) return;
    if (sinks > deepest)
        meeting.next = time + (until - time) * std::max(0.05, std::sqrt(deep / sinks));
    else if (until < end)
        meeting.next = until;
}

/// m/s, of the second from the first at a point.
double ContactSolver::partingAt(const Meeting& meeting, const Point& where, const Point& axis) const {
    const Point other = meeting.grounded() ? Point{} : bodies_[meeting.b].velocityAt(where);
    return dot(other - bodies_[meeting.a].velocityAt(where), axis);
}

/// Whether a pair that pressed leaves the tick going apart.
bool ContactSolver::parting(const Meeting& meeting) const {
    for (int i = 0; i < meeting.touch.count; ++i)
        if (partingAt(meeting, meeting.touch.spots[i].position, meeting.touch.normal) <= partingSpeed) return false;
    return true;
}

ContactOutcome ContactSolver::outcomeOf(MovingBody& body) const {
    ContactOutcome outcome;
    outcome.moved = body.pushed || body.displaced;
    if (!outcome.moved) return outcome;
    body.advance(tick_->duration);
    outcome.pose = {body.frame.origin.x, body.frame.origin.y, body.heading};
    const Point velocity = body.velocityAt(body.frame.origin);
    outcome.velocity_W = {velocity.x, velocity.y, body.rotation};
    outcome.travel = body.travel;
    return outcome;
}

void ContactSolver::report(const Meeting& meeting, std::vector<ContactReport>& reports) const {
    ContactReport report;
    report.bodyA = cluster_->bodies[meeting.a].body;
    report.bodyB = meeting.grounded() ? noBody : cluster_->bodies[meeting.b].body;
    report.obstacle = meeting.grounded() ? meeting.pieceB : 0;
    report.normal = meeting.touch.normal;
    if (report.bodyA > report.bodyB) {
        std::swap(report.bodyA, report.bodyB);
        report.normal = -1 * report.normal;
    }
    Point sum;
    for (int i = 0; i < meeting.touch.count; ++i) sum = sum + meeting.touch.spots[i].position;
    report.position = (1.0 / std::max(1, meeting.touch.count)) * sum;
    report.impulse = meeting.impulse;
    reports.push_back(report);
}

}  // namespace mrose
