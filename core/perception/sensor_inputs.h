#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "learning/learned_network.h"
#include "perception/sensed_state.h"

namespace mrose {

/// A quantity that a learned sensor may read, by the name of the network's input.
struct SensorQuantity {
    std::string_view name, unit;
    double (*of)(const SensedState& state);
};
std::span<const SensorQuantity> sensorQuantities();

/// The input that says which robot it is, "robot 2": 1 for the robot of that name, 0 for the others, and the mean for
/// one that nothing was learned of.
std::string robotInput(std::string_view robot);
inline constexpr std::string_view robotInputUnit = "1";

/// Computes a network's inputs from what is true. The same code serves learning and use, and gives the same bits on
/// every processor.
class SensorInputs {
public:
    /// `robots`: those that are told apart. Error: an input that is no such quantity, or of another unit; the text
    /// names it.
    static std::string objection(std::span<const NetworkVariable> inputs, std::span<const std::string> robots);
    /// Inputs without objection.
    SensorInputs(std::span<const NetworkVariable> inputs, std::span<const std::string> robots);

    std::size_t width() const { return rows_.of(-1).size(); }
    /// Writes width() standardised inputs. `robot`: an index into the robots, -1 for any other one.
    void read(const SensedState& state, int robot, float* row) const;
    /// The same without standardisation, for finding means and scales; the mean of an unknown robot is 0.
    void readRaw(const SensedState& state, int robot, double* row) const;

private:
    /// What changes from state to state.
    struct Part {
        std::size_t input = 0;
        double (*of)(const SensedState& state) = nullptr;
        double mean = 0, inverseScale = 1;
    };
    template <class Number>
    struct Rows : std::vector<std::vector<Number>> {
        const std::vector<Number>& of(int robot) const { return (*this)[static_cast<std::size_t>(robot + 1)]; }
    };

    std::vector<Part> parts_;
    Rows<double> raw_;  ///< with what does not change: by robot, from -1 on
    Rows<float> rows_;  ///< the same, standardised
};

}  // namespace mrose
