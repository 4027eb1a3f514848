#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiment/experiment.h"
#include "experiment/trial_expressions.h"
#include "scenario/drawn_values.h"

namespace mrose {

// results.csv of an experiment: columns `draw.NAME`, `feature.NAME`, `measure.NAME` between what runs were and how
// they can be repeated.

/// Its first line, without its end.
std::string experimentHeader(const Experiment& experiment);

/// What repeats a run alone, without a window and in one.
struct RunCommands {
    std::string alone, window;
};
std::string experimentRow(const Experiment& experiment, const RunKey& key, const DrawnValues& drawn,
                          const TrialMeasurement& measurement, const RunResult& result, Nanoseconds tick,
                          const RunCommands& commands);

/// Of a run that could not be begun, and why.
std::string faultyRow(const Experiment& experiment, const RunKey& key, const Error& error, const RunCommands& commands);

/// What such a row says of the run.
RowOutcome rowOutcome(const Experiment& experiment, const std::string& row);

std::vector<VariantSummary> summarised(const Experiment& experiment, const std::map<RunKey, std::string>& rows);

}  // namespace mrose
