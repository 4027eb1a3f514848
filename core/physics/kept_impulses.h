#pragma once

#include <span>
#include <vector>

#include "physics/meeting.h"

namespace mrose {

/// Orders impulses by whom they are between.
bool keyLess(const ContactImpulse& a, const ContactImpulse& b);

/// Those of the tick before that are between the two pieces of `key`; `before` is in the order of keys.
std::span<const ContactImpulse> impulsesOf(const ContactImpulse& key, std::span<const ContactImpulse> before);

/// Appends what a meeting that presses at the tick's end leaves to the next: what it pressed when the tick began, or
/// nothing in numbers, where it only came to press within the tick.
void keepImpulses(const ContactImpulse& key, const Meeting& meeting, std::vector<ContactImpulse>& after);

}  // namespace mrose
