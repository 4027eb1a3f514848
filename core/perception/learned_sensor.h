#pragma once

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

    /// A reading of a state: which one it is, and its error.
    struct Report {
        std::size_t state = 0;
        ReadingError error{};
    };
    /// What is reported of the states, which are in view, in their order, by a draw for each: distributions()
    /// evaluated only as far as it is needed.
    void report(std::span<const SensedState> states, int robot, std::span<const ReadingDraw> draws,
                std::vector<Report>& to) const;

private:
    void readInputs(std::span<const SensedState> states, int robot, float* rows) const;
    /// In their units.
    void describe(const float* outputs, std::size_t first, std::span<double> values) const;

    SensorNetwork network_;
    SensorInputs inputs_;
    RegressorInference reported_, errors_;  ///< the first output, and the others
};

}  // namespace mrose
