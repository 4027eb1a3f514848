#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "behaviour/floor_plan.h"
#include "behaviour/wall_stroke.h"
#include "control/controller.h"
#include "geometry/point.h"

namespace mrose {

struct DriveLimits;

/// Goes behind the ball as seen from a target, then through it towards the target, and kicks where it has something to
/// kick with. Along walls it pushes the ball as they let it, or strikes it off them (WallStroke); it turns it out of
/// corners if it has a ball guide, and leaves it to others if not. Remembers and predicts the ball; searches where it
/// has lost it; gives way to other robots, mildly; backs off where it does not get on.
class ChaseBall final : public Controller {
public:
    struct Options {
        Point target;              ///< where the ball is to go, in the world's frame
        double speed = 0.4;        ///< m/s
        double rotation = 1;       ///< rad/s
        bool kicks = true;         ///< with the first manipulator, where there is one
        double ballRadius = 0.11;  ///< m
        double front = 0.19;       ///< m, of the own front, from the reference point
        double halfWidth = 0.2;    ///< m, of the robot
        bool guide = false;        ///< it has horns beside its front, between which a ball comes along when it turns
        double deadTime = 0.3;     ///< s, by which the robot answers late
        std::optional<WallStroke::Options> stroke = {};  ///< how it gets a ball off a wall; without, it pushes
        /// Without them it takes no heed of walls.
        std::shared_ptr<const FloorPlan> walls = std::make_shared<const FloorPlan>();
    };

    explicit ChaseBall(Options options) : options_(std::move(options)) {}

    std::size_t memorySize() const override;
    std::vector<MemoryEntry> explain(std::span<const std::byte> memory) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    struct Memory;
    struct Situation;
    DriveLimits limits() const;
    Situation situation(const Memory& memory) const;
    Command chase(const Observation& observation, Memory& memory, Decision& decision) const;
    Command search(const Observation& observation, Memory& memory) const;
    Command sweep(const Memory& memory) const;
    Command wait(const Situation& now, const Observation& observation, Memory& memory) const;
    Point aim(const Situation& now, Memory& memory) const;
    bool mustWait(const Situation& now, const Observation& observation, const Memory& memory) const;
    std::optional<Command> strike(const Situation& now, const Observation& observation, Memory& memory) const;
    bool beginsSweeping(const Situation& now, const Observation& observation, Memory& memory) const;
    bool shouldKick(const Observation& observation, const Memory& memory) const;
    void annotate(const Memory& memory, Decision& decision) const;

    Options options_;
};

}  // namespace mrose
