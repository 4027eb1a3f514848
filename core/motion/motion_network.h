#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/error.h"
#include "learning/mlp.h"
#include "motion/kinematic.h"
#include "world/differential_drive.h"
#include "world/time.h"

namespace mrose {

/// One input of a motion network: a quantity, and for those made from commands how the history is read.
struct NetworkInput {
    enum class Quantity {
        velocityV,  ///< forward velocity at the period's start, m/s
        velocityW,  ///< rotation rate at the period's start, rad/s
        commandV,
        commandW,
        turnSense,   ///< -1, 0, 1: the sense in which a driving robot is told to turn, however little
        leftSine,    ///< sine and cosine of the commanded speed of a wheel over its quantum: where wheel speeds come in
                     ///< steps,
        leftCosine,  ///< it tells where between two steps a command lies
        rightSine,
        rightCosine,
        robot,  ///< 1 for the robot called `robot`, 0 for the others, the mean for an unknown one
    };
    enum class Memory {
        none,    ///< the present velocity, or the robot's identity
        mean,    ///< of the commands in force between `newest` and `oldest` seconds before the period's start
        lagged,  ///< of the commands seen through a dead time and a first-order lag, over the period
    };

    Quantity quantity = Quantity::velocityV;
    Memory memory = Memory::none;
    double newest = 0, oldest = 0;  ///< s, for Memory::mean; 0 <= newest < oldest
    double deadTime = 0, lag = 0;   ///< s, for Memory::lagged
    std::string robot;              ///< for Quantity::robot
    double mean = 0, scale = 1;     ///< the network reads (value - mean) / scale
    bool operator==(const NetworkInput&) const = default;
};

/// y = mean + scale * (what the network's output layer gives).
struct NetworkOutput {
    double mean = 0, scale = 1;
    bool operator==(const NetworkOutput&) const = default;
};

/// A learned motion model as a value: everything that its file holds. See README.md of this folder for the two forms.
struct MotionNetwork {
    enum class Form {
        state,    ///< (v, w, commands) -> (dx, dy, dphi, v', w'): five outputs; the paper's
        history,  ///< commands -> (dx, dy, dphi, v0, w0, v1, w1): the motion that the commands alone lead to, with the
                  ///< velocities expected at the period's ends; another start velocity decays by `recovery`
    };
    static constexpr int version = 1;
    static constexpr std::size_t maxInputs = 256, maxOutputs = 7, maxHidden = 4096;

    Form form = Form::state;
    std::string robotType;            ///< "irobot-create"
    bool synthetic = false;           ///< learned from logs that no real robot made
    std::vector<std::string> robots;  ///< whose logs it was learned from
    Nanoseconds period = 100'000'000;
    std::vector<NetworkInput> inputs;
    std::vector<NetworkOutput> outputs;
    Mlp mlp;

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

    std::optional<DifferentialDrive> drive;  ///< geometry fitted to logs of wheel commands

    /// Dead time and lag identified from the logs, and the kinematic baseline fitted to them, one per robot.
    struct Identified {
        std::string robot;
        KinematicParameters kinematics;
        double deadTimeErrorV = 0, deadTimeErrorW = 0;  ///< s, standard errors
        bool operator==(const Identified&) const = default;
    };
    std::vector<Identified> identified;

    struct Source {
        std::string path, hash;
        bool operator==(const Source&) const = default;
    };
    struct Training {
        std::string command;  ///< the command line that made it
        std::string method;   ///< "irprop+", "lm" ...
        std::string loss;     ///< "one-step", "rollout"
        std::uint64_t seed = 0;
        std::int64_t patterns = 0, epochs = 0;
        std::vector<Source> logs;
        bool operator==(const Training&) const = default;
    };
    Training training;

    /// Open-loop errors on the trajectories held out from learning.
    struct HeldOut {
        std::int64_t windows = 0;
        double horizon = 0;                ///< s
        double position = 0, heading = 0;  ///< P and Hd, %
        bool operator==(const HeldOut&) const = default;
    };
    HeldOut heldOut;

    int outputCount() const { return form == Form::state ? 5 : 7; }
    bool operator==(const MotionNetwork&) const = default;
};

/// The text of a network file (TOML) and back, exact to the bit. Error: file, line and key of what does not fit.
std::string networkText(const MotionNetwork& network);
Expected<MotionNetwork> parseNetwork(std::string_view text, const std::string& file);

Expected<MotionNetwork> loadNetwork(const std::filesystem::path& path);
Expected<void> saveNetwork(const MotionNetwork& network, const std::filesystem::path& path);

}  // namespace mrose
