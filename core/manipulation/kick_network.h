#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "geometry/point.h"
#include "io/error.h"
#include "learning/learned_network.h"
#include "perception/reading_form.h"
#include "world/command.h"

namespace mrose {

/// What a kick depends on: its power, the robot's motion, and where the ball lies.
struct KickState {
    double power = 1;  ///< 0 ... 1
    Velocity robot;    ///< m/s, rad/s
    Point ball_B;      ///< m, of its centre in the robot's frame

    static constexpr std::size_t inputs = 5;
    std::array<double, inputs> values() const { return {power, robot.v, robot.w, ball_B.x, ball_B.y}; }
    /// Known when a kick is commanded; where the ball lies only when it acts.
    static constexpr std::size_t knownAtCommand = 3;
};

/// A learned kicker as a value: everything that its file holds (nets/README.md). Two distributions: of the delay, given
/// power and motion at the command; of whether the ball leaves, how fast and in which direction, given all of them when
/// the kick acts.
struct KickNetwork {
    static constexpr const char* kind = "kick";  ///< of its network files

    struct Range {
        double least = 0, most = 0;
        bool operator==(const Range&) const = default;
    };
    /// Beside it: a kicker that is the same every time but for noise of constant size, fitted to the same kicks.
    struct Constant {
        double deadTime = 0;     ///< s
        double speedAtFull = 0;  ///< m/s, in proportion to power, to which the robot's own speed is added
        double hits = 1;         ///< share of the kicks
        double delaySpread = 0, speedSpread = 0, directionSpread = 0;  ///< s, m/s, rad: standard deviations
        bool operator==(const Constant&) const = default;
    };
    /// Mean logarithms of likelihoods on what was not learned from: by kick whether the ball left; by hit its delay,
    /// and its speed and direction.
    struct HeldOut {
        std::int64_t kicks = 0, hits = 0;
        double hit = 0, delay = 0, departure = 0;
        bool operator==(const HeldOut&) const = default;
    };

    std::string robotType;
    int components = 1, members = 1;  ///< of the mixtures, as of ReadingForm
    double direction = 0;             ///< rad, in the robot's frame: in which it kicks; directions are from it
    std::array<Range, KickState::inputs> seen{};
    Constant constant;
    HeldOut heldOut;
    LearnedNetwork learned;  ///< kickInputs() to kickOutputs()
    bool operator==(const KickNetwork&) const = default;

    ReadingForm delayForm() const { return {1, components, members}; }
    ReadingForm departureForm() const { return {2, components, members}; }
    /// Outputs: the delay of all members, whether the ball leaves (a normal quantile), speed and direction of all.
    int delayOutputs() const { return members * delayForm().memberOutputs(); }
};

/// Names and units, with mean 0 and scale 1.
std::vector<NetworkVariable> kickInputs();
std::vector<NetworkVariable> kickOutputs(const KickNetwork& network);

/// The text of a network file (`learning/network_file.h`) and back, exact to the bit. Error: file, line and key of what
/// does not fit, another kind of network.
std::string kickText(const KickNetwork& network);
Expected<KickNetwork> parseKick(std::string_view text, const std::string& file);

Expected<KickNetwork> loadKick(const std::filesystem::path& path);

}  // namespace mrose
