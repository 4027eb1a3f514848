#include "world/state_hash.h"

#include <algorithm>
#include <array>
#include <vector>

// Compiled here: calls of few bytes are many.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "world/second_state_version.h"
#include "world/state_fields.h"

namespace mrose {
namespace {

template <class T>
std::uint64_t hashOfAll(const std::vector<T>& values) {
    if constexpr (!std::is_same_v<T, std::byte>) static_assert(packed<T>);
    return XXH3_64bits(values.data(), values.size() * sizeof(T));
}

/// Of the robots' fields, some robots at a time; each time begins with the hash so far.
std::uint64_t hashOfRobots(const std::vector<RobotState>& robots) {
    constexpr std::size_t atOnce = 16;
    std::array<char, sizeof(std::uint64_t) + atOnce * packedSize<RobotState>()> buffer;
    std::uint64_t hash = 0;
    for (std::size_t first = 0; first < robots.size(); first += atOnce) {
        std::memcpy(buffer.data(), &hash, sizeof hash);
        char* end = buffer.data() + sizeof hash;
        for (std::size_t i = first; i < std::min(first + atOnce, robots.size()); ++i) end = pack(robots[i], end);
        hash = XXH3_64bits(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
    }
    return hash;
}

template <std::size_t n>
std::uint64_t combined(const std::uint64_t (&parts)[n]) {
    return XXH3_64bits(parts, sizeof parts);
}

StateHash hashWith(std::uint64_t messages, const WorldState& state) {
    // Lengths are hashed along with the arrays, so that no two states look alike by what lies where.
    const std::uint64_t world[] = {static_cast<std::uint64_t>(state.tick),
                                   state.seed,
                                   state.robots.size(),
                                   state.objects.size(),
                                   state.contacts.size(),
                                   state.kicks.size(),
                                   state.messages.size(),
                                   state.goals.size(),
                                   state.commands.size(),
                                   state.motion.size(),
                                   hashOfRobots(state.robots),
                                   hashOfAll(state.objects),
                                   hashOfAll(state.contacts),
                                   hashOfAll(state.kicks),
                                   messages,
                                   hashOfAll(state.goals),
                                   hashOfAll(state.commands),
                                   hashOfAll(state.motion)};
    const std::uint64_t memories[] = {state.memory.size(),     state.sensing.size(),     state.past.size(),
                                      hashOfAll(state.memory), hashOfAll(state.sensing), hashOfAll(state.past)};
    const std::uint64_t all = combined(memories);
    if (state.touches.empty()) return {combined(world), all};  // as before there were any
    const std::uint64_t touching[] = {all, state.touches.size(), hashOfAll(state.touches)};
    return {combined(world), combined(touching)};
}

}  // namespace

StateHash hashOf(const WorldState& state) { return hashWith(hashOfAll(state.messages), state); }

StateHash secondVersionHash(const WorldState& state) {
    const std::vector<SecondVersionMessage> messages = secondVersionMessages(state);
    return hashWith(XXH3_64bits(messages.data(), messages.size() * sizeof(SecondVersionMessage)), state);
}

}  // namespace mrose
