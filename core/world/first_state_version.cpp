#include "world/first_state_version.h"

#include <algorithm>
#include <vector>

// Compiled here: calls of few bytes are many.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace mrose {
namespace {

template <class T>
std::uint64_t hashOfArray(const std::vector<T>& values) {
    return XXH3_64bits(values.data(), values.size() * sizeof(T));
}

/// Of some numbers of each robot, sixteen robots at a time; each time begins with the hash so far.
template <class Visit>
std::uint64_t hashOfRobotsThen(const WorldState& state, std::span<const FirstVersionMemory> memories, Visit visit) {
    constexpr std::size_t atOnce = 16;
    std::uint64_t hash = 0;
    std::vector<char> buffer;
    const auto append = [&](const auto& number) {
        const auto* const bytes = reinterpret_cast<const char*>(&number);
        buffer.insert(buffer.end(), bytes, bytes + sizeof number);
    };
    for (std::size_t first = 0; first < state.robots.size(); first += atOnce) {
        buffer.clear();
        append(hash);
        for (std::size_t i = first; i < std::min(first + atOnce, state.robots.size()); ++i)
            visit(state.robots[i], memories[i], append);
        hash = XXH3_64bits(buffer.data(), buffer.size());
    }
    return hash;
}

template <std::size_t n>
std::uint64_t combinedThen(const std::uint64_t (&parts)[n]) {
    return XXH3_64bits(parts, sizeof parts);
}

}  // namespace

void appendMemory(const FirstVersionMemory& memory, WorldState& state) {
    const auto append = [](std::vector<std::byte>& array, const auto& value) {
        const auto* const bytes = reinterpret_cast<const std::byte*>(&value);
        array.insert(array.end(), bytes, bytes + sizeof value);
    };
    append(state.motion, memory.unperturbed);
    append(state.motion, std::uint64_t{memory.hasUnperturbed});
    append(state.motion, std::uint64_t{0});
    append(state.sensing, memory.bias);
    append(state.sensing, memory.self);
    append(state.sensing, memory.selfMeasured);
    append(state.sensing, std::uint64_t{memory.localised});
    append(state.sensing, memory.bearingBias);
    append(state.sensing, std::uint64_t{0});
}

StateHash firstVersionHash(const WorldState& state, std::span<const FirstVersionMemory> memories) {
    const auto world = [](const RobotState& robot, const FirstVersionMemory& memory, auto&& leaf) {
        visitFirstVersionWorld(robot, memory, leaf);
    };
    const auto sensing = [](const RobotState&, const FirstVersionMemory& memory, auto&& leaf) {
        visitFirstVersionSensing(memory, leaf);
    };
    const std::uint64_t ofWorld[] = {static_cast<std::uint64_t>(state.tick),
                                     state.seed,
                                     state.robots.size(),
                                     state.objects.size(),
                                     state.contacts.size(),
                                     state.kicks.size(),
                                     state.goals.size(),
                                     state.commands.size(),
                                     hashOfRobotsThen(state, memories, world),
                                     hashOfArray(state.objects),
                                     hashOfArray(state.contacts),
                                     hashOfArray(state.kicks),
                                     hashOfArray(state.goals),
                                     hashOfArray(state.commands)};
    const std::uint64_t ofMemories[] = {state.robots.size(),       state.memory.size(),
                                        state.past.size(),         hashOfRobotsThen(state, memories, sensing),
                                        hashOfArray(state.memory), hashOfArray(state.past)};
    return {combinedThen(ofWorld), combinedThen(ofMemories)};
}

}  // namespace mrose
