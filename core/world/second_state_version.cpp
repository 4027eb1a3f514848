#include "world/second_state_version.h"

#include <algorithm>
#include <cstring>

namespace mrose {

void readSecondVersion(std::string_view bytes, WorldState& state) {
    SecondVersionMessage then;
    for (std::size_t i = 0; i < state.messages.size(); ++i) {
        std::memcpy(&then, bytes.data() + i * sizeof then, sizeof then);
        SentMessage& message = state.messages[i];
        message = {then.tick, 0, then.from, then.to, then.kind, then.size, {}, 0, 0, {}};
        std::ranges::copy(then.bytes, message.bytes.begin());
        if (then.from < state.robots.size()) message.position = position(state.robots[then.from].pose);
        for (std::size_t before = i; before > 0 && state.messages[before - 1].tick == then.tick; --before)
            message.number += state.messages[before - 1].from == then.from ? 1 : 0;
    }
}

std::vector<SecondVersionMessage> secondVersionMessages(const WorldState& state) {
    std::vector<SecondVersionMessage> messages;
    for (const SentMessage& now : state.messages) {
        SecondVersionMessage& then =
            messages.emplace_back(SecondVersionMessage{now.tick, now.from, now.to, now.kind, now.size, {}});
        std::copy_n(now.bytes.begin(), then.bytes.size(), then.bytes.begin());
    }
    return messages;
}

}  // namespace mrose
