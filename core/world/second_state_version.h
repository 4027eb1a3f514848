#pragma once

#include <string_view>
#include <vector>

#include "world/state_hash.h"

namespace mrose {

// States as they were stored until their version 3: messages were shorter, and arrived at the next control instant
// wherever their sender was.

struct SecondVersionMessage {
    std::int64_t tick = 0;
    std::uint32_t from = 0, to = noBody;
    std::uint32_t kind = 0, size = 0;
    std::array<std::byte, 64> bytes{};
};
static_assert(sizeof(SecondVersionMessage) == 88);

/// Sets the messages of a state, which has its robots already and as many messages as there are bytes for. Where their
/// senders were is not known: they count as sent from where these are.
void readSecondVersion(std::string_view bytes, WorldState& state);

/// The messages of a state as they were then.
std::vector<SecondVersionMessage> secondVersionMessages(const WorldState& state);

/// The hash that a state had then; the same where there are no messages.
StateHash secondVersionHash(const WorldState& state);

}  // namespace mrose
