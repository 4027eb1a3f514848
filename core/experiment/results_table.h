#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"

namespace mrose {

/// A results.csv as it stands: cells without their quotation marks.
struct ResultsTable {
    std::string file;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;

    /// How many columns there are where there is none of that name.
    std::size_t columnOf(std::string_view name) const;
    /// NaN where the cell holds no number.
    double number(std::size_t row, std::size_t column) const;
};

/// Of a batch or an experiment; `place` is its folder, or the file itself. Error: it is no such file, or has a row that
/// is not as wide as its first line.
Expected<ResultsTable> readResultsTable(const std::filesystem::path& place);

}  // namespace mrose
