#pragma once

#include <memory>
#include <utility>

#include "behaviour/wall_stroke.h"
#include "control/controller.h"

namespace mrose {

/// Gets the ball off the wall that it lies at, by WallStroke alone, again and again until it is free; then it stands.
class FreeBall final : public Controller {
public:
    struct Options {
        WallStroke::Options stroke = {};
        Point towards;          ///< where the ball should rather go, in the world's frame: the field's centre
        double front = 0.17;    ///< m, of the own front between the horns, from the reference point
        double deadTime = 0.3;  ///< s, by which the robot answers late
        std::shared_ptr<const FloorPlan> walls = std::make_shared<const FloorPlan>();
    };

    explicit FreeBall(Options options) : options_(std::move(options)) {}

    std::size_t memorySize() const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    struct Memory;
    Command act(const Observation& observation, Memory& memory) const;
    Command sweep(const Observation& observation, Memory& memory, const Pose& robot, const Point& ball) const;
    Command sweeping(const Memory& memory) const;
    void annotate(const Memory& memory, Decision& decision) const;

    Options options_;
};

}  // namespace mrose
