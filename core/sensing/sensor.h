#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "control/observation.h"
#include "world/memory.h"

namespace mrose {

struct BodySight;
struct SensorView;

/// A reading that a sensor gives: the name by which controllers ask for it, and what its records are.
struct ReadingKind {
    ReadingName name;
    const RecordType* type = nullptr;
};

/// An element of a sensor that measures its surroundings: a laser's beam, a sonar, a bumper's segment.
struct SensorElement {
    Pose mount;            ///< in the robot's frame, x along its axis
    double halfWidth = 0;  ///< rad, of its cone; 0: a ray
    double range = 0;      ///< m, how far it reaches
    double reference = 0;  ///< m, infrared: the range at which a surface that faces it gives intensity 1
};

/// What a robot file says of any sensor beyond those that every robot has.
struct SensorTraits {
    static constexpr std::size_t mostName = 23;  ///< characters: its readings may add to them

    std::string name;
    Nanoseconds period = 0;
};

/// One sensor of a robot: const itself; what it remembers of a robot lies in the world's state, and its random draws
/// are functions of keys, so that going back is exact. One object serves many robots. A new one is a file pair in this
/// folder (README.md).
class Sensor {
public:
    virtual ~Sensor() = default;

    /// Constant, and no other sensor of its robot has it: "self".
    virtual std::string name() const = 0;
    /// What it gives, constant: at most SensorView::mostReadings.
    virtual std::vector<ReadingKind> gives() const = 0;
    /// From measurement to measurement; they are at whole multiples of it. 0: one at each control instant of its robot.
    virtual Nanoseconds period() const { return 0; }
    /// How long ago a reading was measured when it arrives, the longest if they differ.
    virtual Nanoseconds latency() const { return 0; }
    /// Whether it measures at the very instants, SensorView::measured, that its period and latency say; a measurement
    /// then arrives at the first tick at which its latency is over. Others measure at the nearest ticks.
    virtual bool exact() const { return false; }
    /// How far back it reads poses, from when a reading arrives.
    virtual Nanoseconds lookBack() const { return latency(); }

    /// Whether it reads WorldState::touches, back to the measurement before.
    virtual bool feelsTouches() const { return false; }

    /// How wide and far it looks for bodies, constant; nullptr: it looks for none.
    virtual const BodySight* sight() const { return nullptr; }

    /// The elements whose records it gives as the reading of its own name, constant; empty for other sensors.
    virtual std::vector<SensorElement> elements() const { return {}; }
    /// What conditions, plots and the inspector read of the reading of its own name, where that has several records:
    /// always the same entries, whatever is in it. Empty: how many records there are.
    virtual std::vector<MemoryEntry> summary(const Observation& /*all*/, const Reading& /*reading*/) const {
        return {};
    }

    /// Bytes of memory, constant; multiples of 8 lie aligned for anything.
    virtual std::size_t memorySize() const { return 0; }
    /// Fills the memory at a run's start. All zero before.
    virtual void start(std::span<std::byte> /*memory*/) const {}
    /// Whether a memory from a file can be worked with.
    virtual bool sound(std::span<const std::byte> /*memory*/) const { return true; }
    /// What a memory says.
    virtual void explain(std::span<const std::byte> /*memory*/, MemoryEntries& /*entries*/) const {}

    /// One measurement: what arrives now is added to `out`, as far as `view` wants it. The memory must go on the same
    /// whether anything is wanted or not.
    virtual void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const = 0;
};

using SensorPointer = std::shared_ptr<const Sensor>;

}  // namespace mrose
