#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "motion/motion_model.h"
#include "motion/motion_network.h"
#include "motion/ramped_command.h"

namespace mrose {

/// Computes a network's inputs from what a motion model sees. The same code serves learning and use, and gives the same
/// bits on every processor.
class InputReader {
public:
    explicit InputReader(const MotionNetwork& network);

    std::size_t width() const { return inputs_.size(); }

    /// What a drive of limited acceleration follows at an instant: where the commands begin that a period's inputs are
    /// made from.
    struct Followed {
        Command command;
        Nanoseconds time = std::numeric_limits<Nanoseconds>::min();  ///< of no period
    };
    bool ramps() const { return limits_.ramps() && commands_.size() > 0; }
    /// The instant of which a period's inputs need to know what is followed.
    Nanoseconds beginOf(const MotionInput& input) const { return input.start - fromSeconds(oldest_); }

    /// What it follows at beginOf() the period that begins at `start`, told from the commands of 3 s
    /// (commandsKnownBefore).
    Followed followedFrom(const CommandView& commands, Nanoseconds start) const;

    /// How far before a period's start it may read commands. Of a drive that ramps so far only where nothing is
    /// remembered: the oldest of these commands then tell what it follows where inputs begin.
    Nanoseconds lookBack() const { return fromSeconds(toldFrom_); }

    /// Index of a robot by its name, -1 for one that the network was not learned from.
    int robotIndex(const std::string& name) const;

    /// Writes width() standardised inputs. `followed`, where it is given and anything ramps, is read if it is of
    /// this period, and written for the next one.
    void read(const MotionInput& input, int robot, float* row, Followed* followed = nullptr) const;

    /// The same without standardisation, for finding its means and scales.
    void readRaw(const MotionInput& input, int robot, double* row, Followed* followed = nullptr) const;

private:
    static constexpr std::size_t commandWidth = 3, wheelWidth = 6;  ///< quantities: commandV ..., leftSine ...
    static constexpr std::size_t maxPieces = RampedCommand::mostPieces;

    /// The history as pieces of constant command, newest first: piece i covers ages [ages[i], ages[i + 1]) seconds.
    struct Pieces {
        std::array<double, maxPieces + 1> ages;
        std::array<double, maxPieces * commandWidth> commands;  ///< [piece][quantity]
    };
    /// The parts of the history that inputs are means over, for quantities that are computed together.
    class Bins {
    public:
        Bins(const std::vector<NetworkInput>& inputs, NetworkInput::Quantity first, NetworkInput::Quantity last);

        std::size_t size() const { return bins_.size(); }
        double oldest() const { return oldest_; }              ///< s: nothing older is read
        std::size_t indexOf(const NetworkInput& input) const;  ///< size() if it has no bin

        /// The first of the pieces that are read, and the one after the last.
        std::pair<std::size_t, std::size_t> reach(const Pieces& pieces) const;

        /// Writes means [bin][quantity] of values [piece][quantity]; returns their end.
        template <std::size_t Width>
        double* means(const Pieces& pieces, const double* values, double* means) const;

        struct Bin {
            double newest, oldest;  ///< s
            double perLength;       ///< 1/s
        };
        std::span<const Bin> bins() const { return bins_; }

    private:
        std::vector<Bin> bins_;  ///< by `newest`
        double oldest_ = 0;
    };
    /// What the inputs are picked from: the means of both kinds of bins, then the inputs not made from commands.
    using Values = std::array<double, wheelWidth * MotionNetwork::maxInputs>;

    void compute(const MotionInput& input, int robot, Followed* followed, Values& values) const;
    std::size_t collect(const MotionInput& input, double oldest, Pieces& pieces) const;
    Command rampMeans(const Pieces& pieces, std::size_t count, const Command& begun, double* means) const;
    void limitWheels(double* means) const;
    double* wheelMeans(const Pieces& pieces, double* means) const;

    std::vector<NetworkInput> inputs_, others_;  ///< the others are not made from commands
    std::vector<std::string> robots_;
    Bins commands_, wheels_;
    ActuatorLimits limits_;
    double period_;                    ///< s
    double oldest_;                    ///< s: inputs are made from nothing older
    double toldFrom_;                  ///< s: lookBack()
    std::vector<std::size_t> places_;  ///< of the inputs among the values
    std::vector<double> means_, inverseScales_;
    double halfTrack_;   ///< m
    double perQuantum_;  ///< s/m, of the wheels' speeds
    double turnOffset_;
    bool readsTurnSense_;
};

}  // namespace mrose
