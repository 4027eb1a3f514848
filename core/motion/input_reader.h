#pragma once

#include <array>
#include <span>
#include <vector>

#include "motion/motion_model.h"
#include "motion/motion_network.h"

namespace mrose {

/// Computes a network's inputs from what a motion model sees. The same code serves learning and use, and gives the same
/// bits on every processor.
class InputReader {
public:
    explicit InputReader(const MotionNetwork& network);

    std::size_t width() const { return inputs_.size(); }

    /// How far before a period's start it reads commands.
    Nanoseconds memory() const { return fromSeconds(oldestAge_); }

    /// Index of a robot by its name, -1 for one that the network was not learned from.
    int robotIndex(const std::string& name) const;

    /// Writes width() standardised inputs.
    void read(const MotionInput& input, int robot, float* row) const;

    /// The same without standardisation, for finding its means and scales.
    void readRaw(const MotionInput& input, int robot, double* row) const;

private:
    static constexpr std::size_t quantities = 9;  ///< those made from commands: commandV ... forwardCosine
    static constexpr std::size_t maxPieces = CommandHistory::capacity + 1;

    /// The history as pieces of constant command, newest first: piece i covers ages [ages[i], ages[i + 1]) seconds.
    struct Pieces {
        std::size_t count = 0;
        std::array<double, maxPieces + 1> ages;
        std::array<std::array<double, maxPieces>, quantities> values;
    };
    /// A part of the history, and the inputs that are means over it.
    struct Bin {
        double newest, oldest;  ///< s
        struct Member {
            std::size_t input, quantity;
        };
        std::vector<Member> members;
    };

    void collect(const MotionInput& input, Pieces& pieces) const;
    void addWheelPhases(Pieces& pieces) const;
    static void readBin(const Bin& bin, const Pieces& pieces, double* row);
    std::vector<NetworkInput> inputs_;
    std::vector<std::string> robots_;
    std::vector<Bin> bins_;
    std::vector<std::size_t> others_;  ///< inputs that are not made from commands
    std::vector<double> inverseScales_;
    MotionNetwork::WheelPhase wheelPhase_;
    double turnOffset_;
    double oldestAge_;  ///< s: nothing older is read
    bool readsWheels_ = false;
};

}  // namespace mrose
