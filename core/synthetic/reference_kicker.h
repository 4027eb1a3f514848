#pragma once

#include <cstdint>

#include "geometry/point.h"
#include "world/command.h"

namespace mrose {

/// The physical constants of the reference kicker: all of them assumptions. Lengths in m, times in s.
struct ReferenceKickerParameters {
    // From the command to the ball.
    double deadTime = 0.045;                    ///< of the link and the valve at full power ...
    double slowStart = 0.025;                   ///< ... and what it takes longer at none
    double poll = 0.010;                        ///< commands are looked for so often, at a random phase
    double deadTimeTail = 0.005;                ///< mean of what it is late beside that (exponential)
    double face = 0.225, halfWidth = 0.11;      ///< of the face: before the axle, to either side
    double ballRadius = 0.11, reach = 0.06;     ///< how far before the face it still meets the ball
    double edge = 0.004;                        ///< standard deviation of where reach and width end
    double speed = 4.2, powerExponent = 0.8;    ///< m/s at full power, and how it grows with it
    double perGap = 2.5;                        ///< 1/m: share that is lost on the way to the ball
    double droop = 0.10, kicksOfBattery = 250;  ///< share that is lost until the battery is changed, and after how many
    double hollow = 0.35, ripple = 0.05;        ///< share that is lost at the edges; unevenness in waves of 15 cm
    double crown = 1.6, skew = 0.02, bend = 0.05;  ///< rad/m, rad: how the face turns the ball aside; uneven likewise
    double speedNoise = 0.03, directionNoise = 0.012, noiseAtEdge = 0.03;  ///< shares and rad
    double grip = 0.6;                        ///< share of the face's sideways velocity that the ball takes along
    double leastRoll = 0.1, mostRoll = 0.25;  ///< share of its speed with which the ball already rolls
    double spin = 8;                          ///< rad/s about the vertical for each m/s and m off the middle
};

/// How a ball leaves the kicker, in the robot's frame; the rest at rest.
struct ReferenceDeparture {
    bool hit = false;
    Point velocity;   ///< m/s
    double roll = 0;  ///< share of the velocity by which it rolls
    double spin = 0;  ///< rad/s about the vertical
};

/// A kicker of another class than Manipulator and what is learned: speed is no multiple of power, the face is uneven,
/// the battery runs down, and delay, speed and direction scatter, most at the edges. All randomness is a function of
/// the seed and of the number of the kick.
class ReferenceKicker {
public:
    explicit ReferenceKicker(std::uint64_t seed, const ReferenceKickerParameters& parameters = {})
        : seed_(seed), p_(parameters) {}

    const ReferenceKickerParameters& parameters() const { return p_; }

    /// s, from a command of so much power, 0 ... 1, to when the face meets the ball.
    double delay(double power, std::int64_t kick) const;
    /// What becomes of a ball at rest whose centre is at `ball_B` then, as the robot moves with `robot`.
    ReferenceDeparture strike(double power, const Point& ball_B, const Velocity& robot, std::int64_t kick) const;

private:
    std::uint64_t seed_;
    ReferenceKickerParameters p_;
};

}  // namespace mrose
