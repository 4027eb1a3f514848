#include "world/state_hash.h"

#include <algorithm>
#include <array>
#include <vector>

// Compiled here, so that the hasher can live on the stack.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "world/state_fields.h"

namespace mrose {
namespace {

class Hasher {
public:
    Hasher() { XXH3_64bits_reset(&state_); }
    void add(const void* bytes, std::size_t size) { XXH3_64bits_update(&state_, bytes, size); }

    template <class T>
    void add(const std::vector<T>& values) {
        if constexpr (!std::is_same_v<T, std::byte>) static_assert(packed<T>);
        if (!values.empty()) add(values.data(), values.size() * sizeof(T));
    }
    /// The robots' fields, some robots at a time.
    template <class F>
    void addRobots(const std::vector<RobotState>& robots) {
        constexpr std::size_t atOnce = 16;
        std::array<char, atOnce * packedSize<RobotState, F>()> buffer;
        for (std::size_t first = 0; first < robots.size(); first += atOnce) {
            char* end = buffer.data();
            for (std::size_t i = first; i < std::min(first + atOnce, robots.size()); ++i) end = pack<F>(robots[i], end);
            add(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
        }
    }
    std::uint64_t digest() const { return XXH3_64bits_digest(&state_); }

private:
    XXH3_state_t state_;
};

}  // namespace

StateHash hashOf(const WorldState& state) {
    Hasher world;
    // Lengths go first, so that no two states are the same run of bytes.
    const std::array<std::uint64_t, 8> head{static_cast<std::uint64_t>(state.tick),
                                            state.seed,
                                            state.robots.size(),
                                            state.objects.size(),
                                            state.contacts.size(),
                                            state.kicks.size(),
                                            state.goals.size(),
                                            state.commands.size()};
    world.add(head.data(), sizeof head);
    world.addRobots<RobotWorldFields>(state.robots);
    world.add(state.objects);
    world.add(state.contacts);
    world.add(state.kicks);
    world.add(state.goals);
    world.add(state.commands);

    Hasher minds;
    const std::array<std::uint64_t, 3> sizes{state.robots.size(), state.memory.size(), state.past.size()};
    minds.add(sizes.data(), sizeof sizes);
    minds.addRobots<RobotMindFields>(state.robots);
    minds.add(state.memory);
    minds.add(state.past);
    return {world.digest(), minds.digest()};
}

}  // namespace mrose
