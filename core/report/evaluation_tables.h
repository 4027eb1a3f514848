#pragma once

#include <string>

#include "report/evaluation_report.h"

namespace mrose {

/// One row per model: P, Hd, errors per window, biases.
std::string modelTable(const Evaluation& evaluation);

/// P and Hd of every model by robot, by manoeuvre and by state.
std::string groupTable(const Evaluation& evaluation);

/// RMS relative pose errors, one row per horizon.
std::string relativeTable(const Evaluation& evaluation);

/// Every model on the stretches of the floor's pairs.
std::string floorTable(const Evaluation& evaluation);

/// What was wrong with the log, one row per robot.
std::string defectTable(const LogWindows& log);

/// Errors of one window, one row per model.
std::string windowTable(const Evaluation& evaluation, std::size_t window);

/// Files with their hashes.
std::string fileTable(const std::vector<LogFile>& files);

}  // namespace mrose
