#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "behaviour/back_off.h"
#include "behaviour/ball_belief.h"
#include "behaviour/floor_plan.h"
#include "behaviour/own_belief.h"
#include "behaviour/pushing_way.h"
#include "behaviour/wall_stroke.h"
#include "control/controller.h"
#include "geometry/point.h"

namespace mrose {

struct DriveLimits;

/// Goes behind the ball as seen from a target, then through it towards the target, and kicks where it has something to
/// kick with. Along walls it pushes the ball as they let it, or strikes it off them (WallStroke) where nobody else is
/// near; it turns it out of corners if it has a ball guide, and leaves it to others if not; if it strikes, it turns it
/// out of jams with other robots, too. Remembers and predicts the ball; searches where it has lost it; drives round
/// other robots, but for those at the ball; backs off where it does not get on.
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
        bool yields = true;        ///< it waits aside while another robot is at a ball at a wall
        double deadTime = 0.3;     ///< s, by which the robot answers late
        std::optional<WallStroke::Options> stroke = {};  ///< how it gets a ball off a wall; without, it only pushes
        /// Without them it takes no heed of walls.
        std::shared_ptr<const FloorPlan> walls = std::make_shared<const FloorPlan>();
    };

    enum Phase : std::int64_t {
        searching,
        roaming,
        goingBehind,
        pushing,
        straightOn,
        backingOff,
        sweeping,
        waiting,
        striking,
        sweepingJam
    };
    static const char* name(std::int64_t phase);

    struct Memory {
        MotionMemory motion;
        OwnBelief self;
        BackOff backOff;
        BallBelief ball;
        std::int64_t phase;
        Nanoseconds phaseEnd;  ///< of searching, roaming, going straight on and sweeping
        Nanoseconds nextKick;
        Point aim;    ///< in the world's frame
        double turn;  ///< 1 or -1, to the left or right, of searching and sweeping
    };

    /// What counts for the way round the ball, when the command takes effect.
    struct Situation {
        Pose robot;
        Point ball;
        std::vector<FloorPlan::Wall> walls;  ///< near the ball
        PushingWay way;
    };

    explicit ChaseBall(Options options) : options_(std::move(options)) {}

    // For controllers that chase the ball now and then, or know more of it than they see. Of the memory, motion, own
    // pose and ball are those of now, and the pose is known.

    const Options& options() const { return options_; }
    Situation situation(const Memory& memory) const;
    /// What it does about the ball. `stroke`: what it remembers of that, where its options have one; otherwise null.
    /// `others`: where robots are, in the world's frame, as far as is known.
    Command play(const Observation& observation, Memory& memory, WallStroke* stroke, std::span<const Point> others,
                 Decision& decision) const;
    /// What gets the robot off where it does not get on; nullopt: it does.
    std::optional<Command> backOff(const Observation& observation, Memory& memory) const;
    /// Looks for a ball of which nothing is known.
    Command search(const Observation& observation, Memory& memory) const;
    /// Goes to a place, round others, and looks from there at something.
    Command standBy(const Point& place, const Point& watched, Memory& memory, std::span<const Point> others) const;
    void explain(const Memory& memory, MemoryEntries& entries) const;

    std::size_t memorySize() const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

    BallFloor floor() const;

private:
    DriveLimits limits() const;
    Command chase(const Observation& observation, Memory& memory, WallStroke* stroke, std::span<const Point> others,
                  Decision& decision) const;
    Command goTo(const Point& place, const Pose& from, std::span<const Point> others) const;
    Command sweep(const Memory& memory) const;
    Command wait(const Situation& now, Memory& memory, std::span<const Point> others) const;
    Point aim(const Situation& now, Memory& memory) const;
    bool mustWait(const Situation& now, std::span<const Point> others) const;
    std::optional<Command> strike(const Situation& now, const Observation& observation, Memory& memory,
                                  WallStroke& stroke) const;
    static bool isSweeping(const Memory& memory);
    bool beginsSweeping(const Situation& now, const Observation& observation, std::span<const Point> others,
                        Memory& memory) const;
    bool shouldKick(const Observation& observation, const Memory& memory) const;
    void annotate(const Memory& memory, Decision& decision) const;

    Options options_;
};

}  // namespace mrose
