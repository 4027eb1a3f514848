#include "world/state_bytes.h"

#include <array>

#include "io/bytes.h"
#include "world/first_state_version.h"
#include "world/second_state_version.h"
#include "world/state_fields.h"

namespace mrose {
namespace {

constexpr std::uint32_t version = 3;

/// Of an element of an array.
template <class T>
constexpr std::size_t storedSize(std::uint32_t of) {
    if constexpr (std::is_same_v<T, std::byte>)
        return 1;
    else if (std::is_same_v<T, RobotState> && of == 1)
        return firstVersionSize;
    else if (std::is_same_v<T, SentMessage> && of == 2)
        return sizeof(SecondVersionMessage);
    else
        return packedSize<T>();
}

/// All arrays of a state, in the order in which they are stored; the first version had no messages, and no memory of
/// motion models and sensors by itself, the second no touches.
template <class State, class Visit>
void eachArray(State& state, std::uint32_t of, Visit&& visit) {
    visit(state.robots);
    visit(state.objects);
    visit(state.contacts);
    visit(state.kicks);
    if (of > 1) visit(state.messages);
    visit(state.goals);
    visit(state.commands);
    if (of > 1) visit(state.motion);
    visit(state.memory);
    if (of > 1) visit(state.sensing);
    visit(state.past);
    if (of > 2) visit(state.touches);
}
constexpr std::size_t arrayCount = 12;

template <class Vector>
using ElementOf = typename std::remove_cvref_t<Vector>::value_type;

void appendRobots(const std::vector<RobotState>& robots, std::string& bytes) {
    for (const RobotState& robot : robots) {
        std::array<char, packedSize<RobotState>()> buffer;
        bytes.append(buffer.data(), static_cast<std::size_t>(pack(robot, buffer.data()) - buffer.data()));
    }
}

/// Whether all flags were 0 or 1.
bool readRobots(std::string_view bytes, WorldState& state, std::uint32_t of) {
    const char* from = bytes.data();
    bool sound = true;
    const auto read = [&](auto& number) {
        if constexpr (std::is_same_v<std::remove_reference_t<decltype(number)>, bool>) {
            sound = sound && (*from == 0 || *from == 1);
            number = *from == 1;
        } else {
            std::memcpy(&number, from, sizeof number);
        }
        from += sizeof number;
    };
    for (RobotState& robot : state.robots) {
        if (of > 1) {
            visitNumbers(robot, read);
            continue;
        }
        FirstVersionMemory memory;
        visitFirstVersionWorld(robot, memory, read);
        visitFirstVersionSensing(memory, read);
        robot.lastControl = robot.segment.startTick;
        appendMemory(memory, state);
    }
    return sound;
}

}  // namespace

void appendStateBytes(const WorldState& state, std::string& bytes) {
    appendNumber(bytes, version);
    eachArray(state, version, [&](const auto& array) { appendNumber(bytes, std::uint64_t{array.size()}); });
    appendNumber(bytes, state.tick);
    appendNumber(bytes, state.seed);
    eachArray(state, version, [&](const auto& array) {
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

std::uint32_t stateVersion(std::string_view bytes) { return ByteReader(bytes).number<std::uint32_t>(); }

Expected<WorldState> parseState(std::string_view bytes, const std::string& name) {
    ByteReader reader(bytes);
    const auto found = reader.number<std::uint32_t>();
    if (found < 1 || found > version)
        return fail(name, "holds a state of version " + std::to_string(found) + "; expected at most " +
                              std::to_string(version));
    std::array<std::uint64_t, arrayCount> sizes{};
    std::size_t k = 0;
    WorldState state;
    eachArray(state, found, [&](const auto&) { sizes[k++] = reader.number<std::uint64_t>(); });
    state.tick = reader.number<std::int64_t>();
    state.seed = reader.number<std::uint64_t>();

    const std::string badSizes = "holds a state whose sizes do not fit its " + std::to_string(bytes.size()) + " bytes";
    if (reader.failed()) return fail(name, badSizes);
    std::uint64_t rest = reader.rest().size();
    bool fits = true;
    k = 0;
    eachArray(state, found, [&](const auto& array) {
        using Element = ElementOf<decltype(array)>;
        const std::size_t each = storedSize<Element>(found);
        const std::uint64_t size = sizes[k++];
        fits = fits && size <= rest / each;
        if (fits) rest -= size * each;
    });
    if (!fits || rest != 0) return fail(name, badSizes);

    bool sound = true;
    k = 0;
    eachArray(state, found, [&](auto& array) {
        using Element = ElementOf<decltype(array)>;
        array.resize(sizes[k++]);
        const std::string_view part = reader.take(array.size() * storedSize<Element>(found));
        if constexpr (std::is_same_v<Element, RobotState>) {
            sound = readRobots(part, state, found);
            return;
        }
        if constexpr (std::is_same_v<Element, SentMessage>)
            if (found == 2) return readSecondVersion(part, state);
        if (!part.empty()) std::memcpy(array.data(), part.data(), part.size());
    });
    if (!sound) return fail(name, "holds a state with a flag that is neither 0 nor 1");
    return state;
}

}  // namespace mrose
