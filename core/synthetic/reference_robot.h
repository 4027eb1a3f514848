#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "geometry/pose.h"
#include "world/command.h"
#include "world/time.h"

namespace mrose {

/// The physical constants of the reference robot, which stands in for a Pioneer 1 where no log of a real one exists.
/// Lengths in m, speeds in m/s, times in s. Speed, acceleration, command rate and dead time are those of the Pioneer
/// 1's parameter file and of Buck, Beetz and Schmitt (2002); the others are assumptions.
struct ReferenceRobotParameters {
    // From a command's issue to the on-board controller.
    double deadTime = 0.300, deadTimeJitter = 0.009;        ///< of the link; jitter is a standard deviation
    double samplingPeriod = 0.030, samplingJitter = 0.002;  ///< commands are looked for so often, at a random phase

    // The on-board controller: set-points in whole steps, limited in speed and acceleration, then one PI loop a wheel.
    double largestSpeed = 0.4, largestTurn = 1.7453292519943295;       ///< turn rates in rad/s
    double acceleration = 0.5, turnAcceleration = 5.2359877559829888;  ///< m/s2, rad/s2
    double setPointQuantum = 0.001;                                    ///< m/s, of one wheel
    double largestWheelSpeed = 0.50;
    double servoPeriod = 0.020;
    double encoderQuantum = 0.0002;             ///< m of travel
    double proportional = 1.2, integral = 8.0;  ///< 1, 1/s

    // Wheels and motors.
    double track = 0.330;
    double motorLag = 0.12;
    double largestDrive = 0.62;  ///< m/s: the speed that the full voltage leads to without load
    double coupling = 0.15;      ///< share of one wheel's acceleration that the robot's mass gives to the other
    double friction = 0.035;     ///< m/s of drive that a rolling wheel loses
    double stiction = 0.055;     ///< m/s of drive that a standing wheel needs to break loose
    std::array<double, 2> wheelScale{0.993, 1.006};  ///< left, right: true over nominal radius

    // Ground contact.
    double scrub = 0.04, scrubNoise = 0.008;  ///< share of the rotation that tyres lose
    double scrubAtSpeed = 0.25;               ///< s/m: further share, with forward speed
    double turnDrag = 0.05;                   ///< m/s of forward speed lost for each m/s * rad/s of |v w|
    double sideSlip = 0.03;  ///< s: sideways velocity, away from the turn's centre, for each m/s * rad/s of v w
    double casterOffset = 0.20, casterTrail = 0.03;  ///< m: behind the axle; from its pivot to its contact
    double casterTurn = 0.035;                       ///< rad/s by which a caster at right angles turns the robot

    // What no two runs share, slowly varying: relative speed error of each wheel and of both, and a turn rate in
    // motion.
    double gripTime = 2.0;                            ///< s
    double wheelNoise = 0.0053, commonNoise = 0.007;  ///< standard deviations

    bool operator==(const ReferenceRobotParameters&) const = default;
};

/// What advances in time, as one value.
struct ReferenceRobotState {
    static constexpr std::size_t linkCapacity = 32;

    Nanoseconds time = 0;  ///< since the robot was switched on
    Pose pose;             ///< of the axle's middle
    Velocity velocity;     ///< of the body, forward and turning

    /// Commands on their way, in the order of their arrival.
    struct Arriving {
        Nanoseconds time = 0;
        Command command;
    };
    std::array<Arriving, linkCapacity> link{};
    std::size_t linkSize = 0;
    std::int64_t issued = 0;  ///< so far

    Nanoseconds nextSample = 0;
    std::int64_t samples = 0;
    Command command;   ///< that the on-board controller last read
    Command setPoint;  ///< on its way there at the limited acceleration

    struct Wheel {
        double speed = 0;  ///< m/s of the tyre's surface
        double travel = 0;
        double counted = 0;  ///< m: travel in whole encoder steps, when the servo last looked
        double integral = 0, drive = 0;
        double grip = 0;  ///< relative speed error
    };
    std::array<Wheel, 2> wheels;  ///< left, right
    double commonGrip = 0, extraScrub = 0;
    double casterAngle = 0;  ///< rad, of its rolling direction; 0 when the robot has driven forward
};

/// Two driven wheels with motor lag, speed loops on quantised encoders, limited speed and acceleration, friction,
/// unequal radii, scrubbing tyres, side slip and a caster, behind a link with dead time and jitter: another class of
/// model than any that is learned or identified here. It makes synthetic logs, and moves robots of the world whose
/// files name it (ReferenceModel).
///
/// All randomness is a function of the seed and of what it is drawn for: the same seed gives the same bits.
class ReferenceRobot {
public:
    static constexpr Nanoseconds step = 2'000'000;

    /// Without a seed nothing is random: all noise is 0, and the controller in the middle of its period.
    explicit ReferenceRobot(std::optional<std::uint64_t> seed, const ReferenceRobotParameters& parameters = {})
        : seed_(seed), parameters_(parameters) {}

    const ReferenceRobotParameters& parameters() const { return parameters_; }

    /// Standing at `pose`, switched on at a random moment of its controller's period.
    ReferenceRobotState start(const Pose& pose) const;

    /// Sends a command at the state's time, or at another one near it. A full link drops it, as a real one does.
    ReferenceRobotState issue(ReferenceRobotState state, const Command& command) const;
    ReferenceRobotState issue(ReferenceRobotState state, const Command& command, Nanoseconds time) const;

    /// The state one `step` later.
    ReferenceRobotState next(ReferenceRobotState state) const;

    /// Something has changed the body's velocity to this one, and the wheels roll with it.
    ReferenceRobotState pushed(ReferenceRobotState state, const Velocity& velocity) const;

private:
    double normal(std::int64_t draw, std::uint32_t channel) const;
    void sampleCommand(ReferenceRobotState& state) const;
    void servo(ReferenceRobotState& state) const;
    void wander(ReferenceRobotState& state) const;
    void turnWheels(ReferenceRobotState& state, double seconds) const;
    void move(ReferenceRobotState& state, double seconds) const;

    std::optional<std::uint64_t> seed_;
    ReferenceRobotParameters parameters_;
};

}  // namespace mrose
