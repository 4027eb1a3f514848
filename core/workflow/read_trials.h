#pragma once

#include <string>
#include <vector>

#include "debug/opened_run.h"
#include "io/error.h"

namespace mrose {

/// A run of a batch or an experiment: how it is opened, and what became of it.
struct TrialRow {
    OpenRequest request;
    double end = 0;  ///< s: where it ended
    std::vector<std::string> cells;
};

/// The rows of a results.csv that `mrose batch` or `mrose experiment` wrote. Scenario and log are looked for from here,
/// then from the folders that hold the results. Error: file and line of what is no such row.
struct TrialTable {
    std::vector<std::string> columns;  ///< of `cells`
    std::vector<TrialRow> rows;
};
Expected<TrialTable> readTrials(const std::string& path);

}  // namespace mrose
