#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/tracker_offset.h"
#include "io/error.h"
#include "learning/learned_network.h"
#include "motion/actuator_limits.h"
#include "motion/kinematic.h"
#include "motion/motion_noise.h"
#include "world/differential_drive.h"
#include "world/time.h"

namespace mrose {

/// One input of a motion network: a quantity; those made from commands are means over a part of the history.
struct NetworkInput {
    enum class Quantity {
        velocityV,   ///< forward velocity at the period's start, m/s
        velocityW,   ///< rotation rate at the period's start, rad/s
        robot,       ///< 1 for the robot called `robot`, 0 for the others, the mean for an unknown one
        commandV,    ///< m/s
        commandW,    ///< rad/s
        turnSense,   ///< -1, 0, 1: the sense in which a driving robot is commanded to turn, however little
        leftSine,    ///< sine and cosine of the commanded speed of a wheel over its quantum: where wheel speeds come in
        leftCosine,  ///< steps, they say where between two steps a command lies
        rightSine,
        rightCosine,
        forwardSine,  ///< likewise of the forward speed over two quanta
        forwardCosine,
    };

    Quantity quantity = Quantity::velocityV;
    double newest = 0,
           oldest = 0;           ///< s before the period's start, 0 <= newest < oldest; for what is made from commands
    std::string robot;           ///< for Quantity::robot
    double mean = 0, scale = 1;  ///< the network reads (value - mean) / scale
    bool operator==(const NetworkInput&) const = default;

    bool fromCommands() const { return quantity >= Quantity::commandV; }
    bool fromWheels() const { return quantity >= Quantity::leftSine; }
};

/// y = mean + scale * (what the network's output layer gives).
struct NetworkOutput {
    double mean = 0, scale = 1;
    bool operator==(const NetworkOutput&) const = default;
};

/// What a period is like that the noise of its motion depends on, by its share of what the mean predicts.
enum class NoiseTrait {
    moving,         ///< 0 of a robot at rest, 1 of one that moves: steep at 5 mm/s and 0.05 rad/s
    distance,       ///< m, forward or backward
    rotation,       ///< rad, either way
    unevennessV,    ///< m: by how much the commands vary that the network reads, summed, times the period
    unevennessW,    ///< rad
    forward,        ///< m; negative: backward
    forwardChange,  ///< m, from the period before: commands that act early or late
    headingChange,  ///< rad
};
constexpr std::size_t noiseTraitCount = 8;
using NoiseTraits = std::array<double, noiseTraitCount>;

/// By how much a real robot's motion differs from the mean that a network predicts, from run to run. To a period's
/// increment is added exp(scale * z) times the sum of its processes (each its amplitude times n) and of the members'
/// increments less the mean's (each times n, weight and 1/sqrt(members - 1)). Each z and n is normal with mean 0 and
/// variance 1 and forgets itself exponentially with its time constant.
struct ResidualNoise {
    static constexpr std::size_t maxProcesses = 24, maxMembers = 64, maxValues = maxProcesses + maxMembers + 1;

    enum class Axis { forward, left, heading };
    struct Share {
        NoiseTrait trait = NoiseTrait::moving;
        double weight = 0;  ///< m or rad per unit of the trait, not negative
        bool operator==(const Share&) const = default;
    };
    struct Process {
        Axis axis = Axis::forward;
        double time = 0;  ///< s, time constant; 0: periods are independent
        std::vector<Share> amplitude;
        bool operator==(const Process&) const = default;
    };
    /// A factor with a time constant, s.
    struct Strength {
        double weight = 0, time = 0;
        bool operator==(const Strength&) const = default;
    };
    std::vector<Process> processes;
    Strength members, scale;
    double horizon = 0;               ///< s: how far rollouts went from whose errors it was learned
    std::int64_t rollouts = 0;        ///< their number
    std::optional<NoiseTraits> most;  ///< without their signs, in these rollouts: what is more counts as much
    std::optional<MotionNoise>
        constant;  ///< the constant noise that forecasts them best, which this one is held against
    bool operator==(const ResidualNoise&) const = default;
};

/// Where the driving lies that a network was learned from. The driving of a period is six numbers (DrivingReader):
/// velocities or what the robot was commanded before, what it is commanded now, and how far commands go back and forth.
/// Prototypes cover all that was learned from; what is far from them the network was never asked to predict.
struct FamiliarDriving {
    static constexpr std::size_t numbers = 6, mostPrototypes = 256;
    static constexpr double bound = 0.9;  ///< a period is called unfamiliar where DrivingReader::unfamiliar is above it
    using Driving = std::array<double, numbers>;

    /// Of the commands of v or w: which part of the history is described, s before the period's start; and how many m/s
    /// or rad/s are 1 in the prototypes.
    struct Channel {
        double newest = 0, oldest = 0, scale = 1;
        bool operator==(const Channel&) const = default;
    };
    Channel v, w;
    std::vector<Driving> prototypes;
    std::array<double, 3> distances{};  ///< exceeded by one in 10, 100 and 1000 of the periods that were held out
    std::int64_t periods = 0;           ///< that were, each from the prototypes of the other folds
    bool operator==(const FamiliarDriving&) const = default;
};

/// A learned motion model as a value: everything that its file holds. nets/README.md explains the file.
struct MotionNetwork {
    enum class Form {
        state,    ///< (v, w, commands) -> (dx, dy, dphi, v', w'): five outputs; the paper's
        history,  ///< commands -> (dx, dy, dphi, v0, w0, v1, w1): the motion that the commands alone lead to, with the
                  ///< velocities at the period's start and end; what differs from them decays by `recovery`
    };
    static constexpr std::size_t maxInputs = LearnedNetwork::maxInputs, maxOutputs = 7;

    Form form = Form::state;
    std::string robotType;            ///< "irobot-create"
    bool synthetic = false;           ///< learned from logs that no real robot made
    std::vector<std::string> robots;  ///< whose logs it was learned from
    Nanoseconds period = 100'000'000;
    std::vector<NetworkInput> inputs;
    std::vector<NetworkOutput> outputs;
    Mlp mlp;
    std::vector<EnsembleMember> members;  ///< empty where it is one network, or they are not known

    struct WheelPhase {
        double halfTrack = 0;  ///< m
        double quantum = 0;    ///< m/s
        bool operator==(const WheelPhase&) const = default;
    };
    WheelPhase wheelPhase;  ///< used by the inputs made from wheels
    double turnOffset = 0;  ///< rad/s: w at or below this turns right, above it left; exactly 0 is straight
    struct Recovery {
        double v = 0, w = 0;  ///< s, time constants
        bool operator==(const Recovery&) const = default;
    };
    Recovery recovery;  ///< form history only

    ActuatorLimits limits;  ///< commandV and commandW are read as the drive follows them

    std::optional<DifferentialDrive> drive;  ///< geometry fitted to logs of wheel commands

    /// What was identified from the logs of one robot: how its tracked point lies to its body, how late it answers, and
    /// the kinematic baselines fitted to it.
    struct Identified {
        struct Delay {
            double deadTime = 0, deadTimeError = 0;  ///< s; the mean over commands, and its standard error
            double lag = 0;                          ///< s
            double jitter = 0;                       ///< s, standard deviation of the single commands' dead times
            bool operator==(const Delay&) const = default;
        };
        std::string robot;
        TrackerOffset tracker;
        Delay v, w;
        KinematicParameters delayed;  ///< dead time alone
        KinematicParameters dynamic;  ///< with lag, gain and bias
        bool operator==(const Identified&) const = default;
    };
    std::vector<Identified> identified;

    std::optional<ResidualNoise> noise;       ///< none: the mean alone is known
    std::optional<FamiliarDriving> familiar;  ///< none: nothing is known of where it can be trusted

    NetworkTraining training;

    /// Open-loop errors on the trajectories held out from learning.
    struct HeldOut {
        std::int64_t windows = 0;
        double horizon = 0;                ///< s
        double position = 0, heading = 0;  ///< P and Hd, %
        HoldOut part{};                    ///< of the logs: kept from every member and from all that was identified
        bool operator==(const HeldOut&) const = default;
    };
    HeldOut heldOut;

    bool operator==(const MotionNetwork&) const = default;
};

/// The text of a network file (`learning/network_file.h`) and back, exact to the bit; files of the first version are
/// read too, and their members are not known. Error: file, line and key of what does not fit, another kind of network.
std::string networkText(const MotionNetwork& network);
Expected<MotionNetwork> parseNetwork(std::string_view text, const std::string& file);

Expected<MotionNetwork> loadNetwork(const std::filesystem::path& path);
Expected<void> saveNetwork(const MotionNetwork& network, const std::filesystem::path& path);

}  // namespace mrose
