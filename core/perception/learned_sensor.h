#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "learning/regressor.h"
#include "perception/sensor_inputs.h"
#include "perception/sensor_network.h"

namespace mrose {

/// A sensor network made ready for use: const, so that robots and threads may share it. What it says of a state has the
/// same bits alone, among others, and on every processor.
class LearnedSensor {
public:
    explicit LearnedSensor(SensorNetwork network);

    const SensorNetwork& network() const { return network_; }

    /// Index of a robot by its name, -1 for one that the network was not learned from.
    int robotIndex(const std::string& name) const;

    /// Whether a subject may be reported at all: of a kind that it reports, within its range and field of view.
    bool inView(const SensedState& state) const;

    /// The distribution of the reading of each state, which is in view (or of the own pose). `robot`: by robotIndex().
    void distributions(std::span<const SensedState> states, int robot, std::span<ReadingDistribution> to) const;

    /// Of which states, which are in view, there is a reading, by ReadingDraw::reported of each: their places are
    /// appended, in their order.
    void reported(std::span<const SensedState> states, int robot, std::span<const double> numbers,
                  std::vector<std::uint32_t>& which) const;
    /// The errors of the readings of `which` of the states, by a draw for each: of distributions(), evaluated only as
    /// far as they need it.
    void errors(std::span<const SensedState> states, std::span<const std::uint32_t> which, int robot,
                std::span<const ReadingDraw> draws, std::span<ReadingError> to) const;

private:
    /// Some of the network's outputs, by the inputs that any of them needs.
    struct Part {
        Part(const SensorNetwork& network, int first, int count, int members);

        SensorInputs inputs;
        std::vector<RegressorInference> members;  ///< `count` outputs each
    };

    /// Outputs in their units.
    void describe(const float* outputs, int first, std::span<double> values) const;

    SensorNetwork network_;
    Part reported_, errors_;
};

}  // namespace mrose
