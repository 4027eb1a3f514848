#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "behaviour/floor_plan.h"
#include "control/controller.h"

namespace mrose {

/// Drives from pose to pose and comes to rest at each, or at the last one. Gives way to robots and boxes that it sees,
/// keeps off walls that it knows, and backs off where it does not get on; it plans nothing: from each target to the
/// next there should be a straight way.
class GoToPose final : public Controller {
public:
    struct Options {
        std::vector<Pose> targets;      ///< in the world's frame; none: it stands
        bool loop = false;              ///< after the last one to the first again
        bool backwards = false;         ///< may drive tail first
        double speed = 0.4;             ///< m/s
        double rotation = 1;            ///< rad/s
        double tolerance = 0.05;        ///< m
        double headingTolerance = 0.1;  ///< rad
        bool ball = false;              ///< the first object is a ball, for which it does not go out of its way
        double radius = 0.3;            ///< m, of a circle about the robot's reference point that holds it
        double deadTime = 0.3;          ///< s, by which the robot answers late
        /// Without them it takes no heed of walls.
        std::shared_ptr<const FloorPlan> walls = std::make_shared<const FloorPlan>();
    };

    explicit GoToPose(Options options) : options_(std::move(options)) {}

    std::size_t memorySize() const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    struct Memory;
    Command drive(const Observation& observation, Memory& memory) const;
    Command approach(const Observation& observation, const Pose& ahead, Memory& memory) const;
    FloorPlan bodiesSeen(const Observation& observation, const Memory& memory) const;
    void annotate(const Memory& memory, Decision& decision) const;
    const Pose& target(const Memory& memory) const;

    Options options_;
};

}  // namespace mrose
