#pragma once

#include <span>

#include "motion/input_reader.h"
#include "motion/motion_model.h"
#include "motion/motion_network.h"

namespace mrose {

/// Reads the driving of a period as FamiliarDriving describes it, and says how unfamiliar it is.
///
/// The commands of each channel are read in `parts` equal parts of the described history. Of form `state` the first two
/// numbers are v and w at the period's start, and the next two the means of the commands. Of form `history`, which
/// reads no velocity, they are the means over the older and the newer half: what the robot was driven by, and what now
/// begins to act. The last two say how far the commands go back and forth: the way from part to part beyond the way
/// from the first to the last, times `reversalWeight`.
class DrivingReader {
public:
    static constexpr std::size_t parts = 8;
    static constexpr double reversalWeight = 0.2;

    /// `channels`: scales and parts of the history; its prototypes are read by `unfamiliar` alone.
    DrivingReader(MotionNetwork::Form form, FamiliarDriving channels);

    const FamiliarDriving& familiar() const { return familiar_; }
    Nanoseconds lookBack() const { return reader_.lookBack(); }
    /// A network that reads what this needs, in the order of `rawWidth` numbers: for the patterns of logs.
    const MotionNetwork& raw() const { return raw_; }

    FamiliarDriving::Driving driving(const MotionInput& input) const;
    /// The same of the inputs that `raw()` names, not standardised.
    FamiliarDriving::Driving driving(std::span<const double> rawInputs) const;

    /// From the nearest prototype.
    double distance(const FamiliarDriving::Driving& driving) const;

    /// 0 ... 1: 0.3, 0.6 and 0.9 at the distances that one in 10, 100 and 1000 of the held-out periods exceed, evenly
    /// in between, and 1 from half as far again.
    double unfamiliar(const MotionInput& input) const { return unfamiliar(driving(input)); }
    double unfamiliar(const FamiliarDriving::Driving& driving) const;
    /// Whether that is more than FamiliarDriving::bound; sooner known than how much it is.
    bool isUnfamiliar(const MotionInput& input) const;

private:
    FamiliarDriving familiar_;
    bool velocities_;
    MotionNetwork raw_;
    InputReader reader_;
};

}  // namespace mrose
