#include "physics/kept_impulses.h"

#include <algorithm>
#include <tuple>

namespace mrose {
namespace {

auto tied(const ContactImpulse& c) { return std::tie(c.bodyA, c.pieceA, c.bodyB, c.pieceB, c.feature); }
auto pieces(const ContactImpulse& c) { return std::tie(c.bodyA, c.pieceA, c.bodyB, c.pieceB); }

}  // namespace

bool keyLess(const ContactImpulse& a, const ContactImpulse& b) { return tied(a) < tied(b); }

std::span<const ContactImpulse> impulsesOf(const ContactImpulse& key, std::span<const ContactImpulse> before) {
    const auto less = [](const ContactImpulse& a, const ContactImpulse& b) { return pieces(a) < pieces(b); };
    const auto [first, last] = std::equal_range(before.begin(), before.end(), key, less);
    return before.subspan(static_cast<std::size_t>(first - before.begin()), static_cast<std::size_t>(last - first));
}

void keepImpulses(const ContactImpulse& key, const Meeting& meeting, std::vector<ContactImpulse>& after) {
    ContactImpulse impulse = key;
    if (meeting.startCount == 0) {
        impulse.feature = meeting.touch.spots[0].which;
        after.push_back(impulse);
    }
    for (int i = 0; i < meeting.startCount; ++i) {
        impulse.feature = meeting.atStart[i].feature;
        impulse.normal = meeting.atStart[i].normal;
        impulse.tangent = meeting.atStart[i].tangent;
        after.push_back(impulse);
    }
}

}  // namespace mrose
