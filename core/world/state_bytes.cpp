#include "world/state_bytes.h"

#include <array>

#include "io/bytes.h"
#include "world/state_fields.h"

namespace mrose {
namespace {

constexpr std::uint32_t version = 1;

template <class T>
constexpr std::size_t storedSize() {
    if constexpr (std::is_same_v<T, std::byte>)
        return 1;
    else
        return packedSize<T>();
}

/// All arrays of a state, in the order in which they are stored.
template <class State, class Visit>
void eachArray(State& state, Visit&& visit) {
    visit(state.robots);
    visit(state.objects);
    visit(state.contacts);
    visit(state.kicks);
    visit(state.goals);
    visit(state.commands);
    visit(state.memory);
    visit(state.past);
}
constexpr std::size_t arrayCount = 8;

template <class Vector>
using ElementOf = typename std::remove_cvref_t<Vector>::value_type;

void appendRobots(const std::vector<RobotState>& robots, std::string& bytes) {
    for (const RobotState& robot : robots) {
        std::array<char, packedSize<RobotState>()> buffer;
        bytes.append(buffer.data(), static_cast<std::size_t>(pack(robot, buffer.data()) - buffer.data()));
    }
}

/// Whether all flags were 0 or 1.
bool readRobots(std::string_view bytes, std::vector<RobotState>& robots) {
    const char* from = bytes.data();
    bool sound = true;
    for (RobotState& robot : robots)
        visitNumbers(robot, [&](auto& number) {
            if constexpr (std::is_same_v<std::remove_reference_t<decltype(number)>, bool>) {
                sound = sound && (*from == 0 || *from == 1);
                number = *from == 1;
            } else {
                std::memcpy(&number, from, sizeof number);
            }
            from += sizeof number;
        });
    return sound;
}

}  // namespace

void appendStateBytes(const WorldState& state, std::string& bytes) {
    appendNumber(bytes, version);
    eachArray(state, [&](const auto& array) { appendNumber(bytes, std::uint64_t{array.size()}); });
    appendNumber(bytes, state.tick);
    appendNumber(bytes, state.seed);
    eachArray(state, [&](const auto& array) {
        using Element = ElementOf<decltype(array)>;
        if constexpr (std::is_same_v<Element, RobotState>)
            appendRobots(array, bytes);
        else if (!array.empty())
            bytes.append(reinterpret_cast<const char*>(array.data()), array.size() * sizeof(Element));
    });
}

std::string stateBytes(const WorldState& state) {
    std::string bytes;
    appendStateBytes(state, bytes);
    return bytes;
}

Expected<WorldState> parseState(std::string_view bytes, const std::string& name) {
    ByteReader reader(bytes);
    if (const auto found = reader.number<std::uint32_t>(); found != version)
        return fail(name,
                    "holds a state of version " + std::to_string(found) + "; expected " + std::to_string(version));
    std::array<std::uint64_t, arrayCount> sizes{};
    for (std::uint64_t& size : sizes) size = reader.number<std::uint64_t>();
    WorldState state;
    state.tick = reader.number<std::int64_t>();
    state.seed = reader.number<std::uint64_t>();

    const std::string misfit = "holds a state whose sizes do not fit its " + std::to_string(bytes.size()) + " bytes";
    if (reader.failed()) return fail(name, misfit);
    std::uint64_t rest = reader.rest().size();
    bool fits = true;
    std::size_t k = 0;
    eachArray(state, [&](const auto& array) {
        constexpr std::size_t each = storedSize<ElementOf<decltype(array)>>();
        const std::uint64_t size = sizes[k++];
        fits = fits && size <= rest / each;
        if (fits) rest -= size * each;
    });
    if (!fits || rest != 0) return fail(name, misfit);

    bool sound = true;
    k = 0;
    eachArray(state, [&](auto& array) {
        using Element = ElementOf<decltype(array)>;
        array.resize(sizes[k++]);
        const std::string_view part = reader.take(array.size() * storedSize<Element>());
        if constexpr (std::is_same_v<Element, RobotState>)
            sound = readRobots(part, array);
        else if (!part.empty())
            std::memcpy(array.data(), part.data(), part.size());
    });
    if (!sound) return fail(name, "holds a state with a flag that is neither 0 nor 1");
    return state;
}

}  // namespace mrose
