#pragma once

#include <span>

#include "physics/contact_task.h"
#include "physics/time_of_touch.h"
#include "physics/touch.h"

namespace mrose {

/// Two pieces that may touch within a tick, and what has become of them so far.
struct Meeting {
    enum class State : std::uint8_t {
        apart,     ///< they may touch; `next` says when
        pressing,  ///< they touched and did not bounce: until the tick's end they get no nearer
    };

    std::uint32_t a = 0, b = 0;  ///< bodies of the cluster; b = noBody for the ground
    std::uint32_t pieceA = 0, pieceB = 0;
    const CollisionShape::Piece *outlineA = nullptr, *outlineB = nullptr;
    double friction = 0, restitution = 0;  ///< as they are in this tick
    std::span<const ContactImpulse> kept;  ///< of the last tick
    bool leant = false;                    ///< it pressed at the last tick's end: it does not bounce

    State state = State::apart;
    bool touches = false;  ///< when the tick begins, or it comes to press
    int bounces = 0, sinkings = 0;
    double next = never;  ///< s, when it touches, or has sunk in
    double atEnd = 0;     ///< m at least from each other when the tick ends, of one that presses
    Touch touch;          ///< when it was last looked at
    Gap gap;              ///< likewise, unless they are far from each other
    bool far = false;     ///< when the tick began: too far to touch in it as planned; `gap` is not known then
    double impulse = 0;   ///< N s, along the normal, in the whole tick
    std::array<ContactImpulse, 2> atStart{};  ///< what it pressed when the tick began: warms the next tick's search
    int startCount = 0;

    bool grounded() const { return b == noBody; }
};

/// All pairs of pieces of a cluster, in the order of its pairs. Their friction and restitution are varied by the
/// paper's random factor, drawn once for each pair of bodies and tick.
void findMeetings(const ContactTick& tick, const ContactCluster& cluster, std::vector<Meeting>& meetings);

/// Whom a meeting is between, as the state keeps it, without what it pressed.
ContactImpulse keyOf(const ContactCluster& cluster, const Meeting& meeting);

}  // namespace mrose
