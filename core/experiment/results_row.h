#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/results_file.h"
#include "experiment/run.h"

namespace mrose {

/// The column, and summary, of the share of a run in which some robot's driving was unfamiliar to its network; there
/// where a robot's network can say so. After it one for each such robot.
constexpr const char* unfamiliarColumn = "unfamiliar";

/// results.csv of a batch: its first line, without its end.
std::string resultsHeader(const ScenarioParts& parts);

/// The row of a run of `parts`, which varied() made: behind what happened stands what of it is varied. `command` is
/// what runs it alone.
std::string resultsRow(const RunKey& key, const RunResult& result, const ScenarioParts& parts,
                       const std::string& command);

/// The cells of a line of results.csv, without their quotation marks.
std::vector<std::string> resultsCells(std::string_view line);

/// What rows have in a column of numbers.
struct ColumnSummary {
    std::string name;
    double mean = 0, least = 0, most = 0;
};

/// What a person wants to know of many rows.
struct ResultsSummary {
    std::int64_t rows = 0;
    std::int64_t ended = 0;   ///< by the condition
    std::int64_t faulty = 0;  ///< with faults
    std::vector<ColumnSummary> columns;

    explicit ResultsSummary(const Scene& scene);
    void add(std::string_view row);
};

}  // namespace mrose
