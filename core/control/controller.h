#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/observation.h"
#include "world/memory.h"

namespace mrose {

struct Kick {
    std::uint32_t manipulator = 0;  ///< index in the robot file
    double power = 1;               ///< 0 ... 1
    bool operator==(const Kick&) const = default;
};
inline bool identical(const Kick& a, const Kick& b) {
    return a.manipulator == b.manipulator && identical(a.power, b.power);
}

constexpr std::uint32_t broadcast = 0xffffffff;

/// What one robot tells another, or all others.
struct RadioMessage {
    static constexpr std::size_t most = mostMessageBytes;  ///< B

    std::uint32_t to = broadcast;  ///< the robot
    std::uint32_t kind = 0;        ///< the sender's own: what the bytes are
    std::uint32_t size = 0;        ///< of the bytes, at most `most`
    std::array<std::byte, most> bytes{};
    bool operator==(const RadioMessage&) const = default;

    /// With a value's bytes: of a type without padding, since all of them are part of the state.
    template <class T>
    static RadioMessage of(const T& value, std::uint32_t kind = 0, std::uint32_t to = broadcast) {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= most);
        RadioMessage message{to, kind, sizeof(T)};
        std::memcpy(message.bytes.data(), &value, sizeof(T));
        return message;
    }
};
inline bool identical(const RadioMessage& a, const RadioMessage& b) { return a == b; }

/// Something that a controller wants the inspector or the field view to show. Never part of the state.
struct Annotation {
    enum class Kind { value, text, point, line };
    Kind kind = Kind::value;
    std::string label;
    double value = 0;           ///< of Kind::value
    std::string text;           ///< of Kind::text
    std::vector<Point> points;  ///< of the others, in the world's frame
};

/// What a controller decided at one instant.
struct Decision {
    std::optional<Command> command;       ///< issued now; nullopt: the one in force stays
    std::vector<StampedCommand> earlier;  ///< issued since the last instant, in order of time: by players of logs
    std::vector<Kick> kicks;
    std::vector<RadioMessage>
        messages;  ///< received at the others' next control instants, or as the scenario's radio says
    std::vector<Annotation> annotations;
    /// Where it is false nobody sees annotations, so that none need be made. Neither orders nor memory may depend on
    /// it.
    bool wantsAnnotations = true;
    std::string breakReason;  ///< not empty: the debugger stops after this tick
    std::string fault;        ///< not empty: the controller failed, and the robot is commanded to stand

    /// Asks the debugger to stop here.
    void breakHere(std::string reason = "breakHere()") { breakReason = std::move(reason); }
    void clear();
    /// The same orders to the last bit, whatever is annotated.
    bool sameOrders(const Decision& other) const;
};

/// Control software of one robot: a pure function of what it sees and of its memory, which belongs to the world's state
/// so that going back is exact. One object may drive many robots.
class Controller {
public:
    virtual ~Controller() = default;

    /// Bytes of memory, constant; multiples of 8 lie aligned for anything.
    virtual std::size_t memorySize() const { return 0; }
    /// Fills the memory at a run's start. All zero before.
    virtual void start(std::span<std::byte> /*memory*/) const {}
    /// How many commands it may issue in one control period of such a length.
    virtual std::size_t commandsPerPeriod(Nanoseconds /*period*/) const { return 1; }
    /// Constant. Reading what it leaves out is an error of the controller (Observation::leaveOut()).
    virtual Attention attention() const { return {}; }

    /// Adds what a memory of this controller says; nothing where it explains nothing.
    virtual void explain(std::span<const std::byte> /*memory*/, MemoryEntries& /*entries*/) const {}

    /// Called once per control period; `decision` is empty.
    virtual void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const = 0;
};

}  // namespace mrose
