#pragma once

#include "scenario/scenario.h"

namespace mrose {

/// Control periods of robots, over a run.
struct FreePeriods {
    int compared = 0;  ///< untouched from beginning to end ...
    int near = 0;      ///< ... of these, with another body or a wall within 5 mm at the beginning
    int touched = 0;   ///< left out
};

/// Runs the scenario and expects of every robot, for each of its control periods in which nothing touched it, the pose
/// that its model predicts when it is asked beside the world.
FreePeriods expectPredictions(const Scenario& scenario, int ticks, double tolerance);

}  // namespace mrose
