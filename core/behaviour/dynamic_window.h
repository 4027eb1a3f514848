#pragma once

#include <utility>
#include <vector>

#include "behaviour/obstacle_memory.h"
#include "control/controller.h"

namespace mrose {

/// Drives from waypoint to waypoint by what its robot's laser, sonars, infrared and bumpers find around it: by the
/// Dynamic Window Approach (Fox, Burgard, Thrun 1997). Of the velocities that the robot can reach until soon and from
/// which it can stop before it touches anything, it takes the one that is best by heading, clearance and progress. It
/// knows no map, sees no bodies, and plans nothing.
class DynamicWindow final : public Controller {
public:
    struct Options {
        std::vector<Point> waypoints;               ///< in the world's frame; none: it stands
        bool loop = false;                          ///< after the last one to the first again
        double tolerance = 0.3;                     ///< m, from a waypoint
        double speed = 0.4;                         ///< m/s
        double rotation = 1;                        ///< rad/s
        double acceleration = 0.5;                  ///< m/s2, also when it brakes
        double turningAcceleration = 2;             ///< rad/s2
        double margin = 0.2;                        ///< m, beside it at full speed
        double lookAhead = 2.5;                     ///< m
        Nanoseconds memory = nanosecondsPerSecond;  ///< how long it goes by an echo
        double headingWeight = 1, clearanceWeight = 0.8, progressWeight = 0.6;
        double radius = 0.3;                  ///< m, of a circle about the robot's reference point that holds it
        double deadTime = 0.3;                ///< s, by which the robot answers late
        std::vector<ObstacleSensor> sensors;  ///< lasers first, bumpers last; one that measures ranges at least
    };

    explicit DynamicWindow(Options options) : options_(std::move(options)) {}

    std::size_t memorySize() const override;
    Attention attention() const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    struct Memory;
    struct Surroundings;
    struct Choice;
    Command drive(const Observation& observation, Memory& memory, Decision& decision) const;
    Surroundings surroundings(const Memory& memory) const;
    Point destination(const Observation& observation, const Surroundings& around, Memory& memory) const;
    Point lane(const Surroundings& around, double wanted, double look) const;
    Choice best(const Surroundings& around, const Point& goal) const;
    Choice valued(const Surroundings& around, const Point& towards, double look, const Command& command) const;
    void markArc(const Surroundings& around, const Choice& choice, Decision& decision) const;
    void noteProgress(const Observation& observation, const Surroundings& around, Memory& memory) const;
    bool noteBump(const Observation& observation, Memory& memory) const;
    Command clearOf(const Surroundings& around, const Command& command) const;
    const Point& waypoint(const Memory& memory) const;

    Options options_;
};

}  // namespace mrose
