#pragma once

#include <memory>
#include <string_view>
#include <utility>

#include "behaviour/floor_plan.h"
#include "behaviour/method_choice.h"
#include "control/controller.h"

namespace mrose {

/// Drives to a pose by a planned path, among walls that it knows and bodies that it sees and remembers, and rests
/// there. Robots of a team tell each other their coming paths; who does not go first, by its index, repairs its own
/// where it conflicts with theirs. What is planned holds until it no longer does. By which method they plan may be
/// chosen on the way: by the first of them, which tells the others.
class Navigate final : public Controller {
public:
    struct Options {
        Pose target;        ///< in the world's frame
        TeamMethod method;  ///< until another one is chosen
        MethodChoice::Options choice;
        double speed = 0.4;             ///< m/s
        double rotation = 1;            ///< rad/s
        double tolerance = 0.05;        ///< m
        double headingTolerance = 0.1;  ///< rad
        bool ball = false;              ///< the first object is a ball, which is no obstacle
        double radius = 0.3;            ///< m, of a circle about the robot's reference point that holds it
        double objectRadius = 0.25;     ///< m, likewise of any object
        double spare = 0.06;            ///< m, that paths keep more from walls and bodies
        double deadTime = 0.3;          ///< s, by which the robot answers late
        std::shared_ptr<const FloorPlan> walls = std::make_shared<const FloorPlan>();
    };
    static constexpr std::size_t mostBodies = 8;  ///< objects and robots, by their indices, that it remembers

    explicit Navigate(Options options) : options_(std::move(options)) {}

    std::size_t memorySize() const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    struct Memory;
    struct Traffic;
    const TeamMethod& methodNow(const Memory& memory) const;
    void chooseMethod(const Observation& observation, Memory& memory) const;
    Command drive(const Observation& observation, Memory& memory) const;
    Command onTheWay(const Observation& observation, const Pose& ahead, Memory& memory) const;
    double freeAhead(const Observation& observation, const Pose& ahead, double most, const Memory& memory) const;
    void noteBlocked(const Observation& observation, bool blocked, Memory& memory) const;
    Traffic traffic(const Observation& observation, const Memory& memory) const;
    bool stillGood(const Traffic& traffic, const Pose& ahead, const Memory& memory) const;
    void plan(const Observation& observation, const Pose& ahead, Memory& memory) const;
    void tell(const Memory& memory, Decision& decision) const;
    void annotate(const Memory& memory, Decision& decision) const;
    std::string_view stateOf(const Memory& memory) const;
    bool yieldsTo(std::size_t mate, std::size_t own, const Memory& memory) const {
        return methodNow(memory).lowestFirst ? mate < own : mate > own;
    }
    DriveTimes driveTimes(double heading) const {
        return {heading, 0.95 * options_.speed, options_.rotation, options_.deadTime};
    }
    double separation() const { return 2 * options_.radius + options_.spare; }

    Options options_;
};

}  // namespace mrose
