#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "assessment/sensor_model.h"
#include "assessment/sensor_scores.h"
#include "perception/reading_distribution.h"
#include "perception/sensed_state.h"

namespace mrose {

/// An instant at which a robot's own localisation could report a pose, and what it did.
struct LocaliserCase {
    SensedState state;  ///< pose and velocity when it was measured
    std::string robot;
    Nanoseconds time = 0;  ///< of the report
    bool reported = false;
    bool sound = false;    ///< reported, and not a gross error
    ReadingError error{};  ///< of the pose in the robot's true frame: ahead, to the left (m), of the heading (rad)
};

/// How good a model's predictions of a localisation are, in means over its cases; those of errors over sound ones.
struct LocaliserScores {
    static constexpr std::size_t dimensions = 3, belowParts = 20;

    std::string name;
    std::size_t cases = 0, readings = 0, sound = 0;
    std::array<ErrorScores, dimensions> error;
    double logDensity = 0;  ///< of all three errors together, 1/(m^2 rad); not a number of what knows no spread
    double detection = 0;   ///< log-likelihood of whether there was a report
    /// How many sound readings had so much probability below them, in equal parts from 0 to 1.
    std::array<std::array<std::size_t, belowParts>, dimensions> below{};
};

LocaliserScores scoreLocaliser(const std::string& name, const SensorModel& model, std::span<const LocaliserCase> cases);

}  // namespace mrose
