#pragma once

#include <memory>
#include <utility>

#include "behaviour/floor_plan.h"
#include "control/controller.h"

namespace mrose {

/// Strolls in smooth random curves, turns away from walls that it knows and from bodies that it sees ahead, and backs
/// off where it does not get on.
class Wander final : public Controller {
public:
    struct Options {
        double speed = 0.3;      ///< m/s
        double rotation = 1;     ///< rad/s
        double changeEvery = 2;  ///< s, on average, until it takes another curve
        double radius = 0.3;     ///< m, of a circle about the robot's reference point that holds it
        double deadTime = 0.3;   ///< s, by which the robot answers late
        std::shared_ptr<const FloorPlan> walls = std::make_shared<const FloorPlan>();
    };

    explicit Wander(Options options) : options_(std::move(options)) {}

    std::size_t memorySize() const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    struct Memory;
    Command alongWalls(const Command& intended, Memory& memory) const;
    Command stroll(const Observation& observation, Memory& memory) const;

    Options options_;
};

}  // namespace mrose
