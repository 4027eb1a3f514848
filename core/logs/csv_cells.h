#pragma once

#include <array>
#include <string>
#include <string_view>

#include "logs/csv_format.h"
#include "logs/csv_rows.h"

namespace mrose {

/// Which cell of a row holds which column.
struct CsvCells {
    std::array<const CsvCell*, csvColumnNames.size()> columns{};  ///< nullptr where the file has none

    bool hasColumn(CsvColumn column) const { return columns[static_cast<std::size_t>(column)] != nullptr; }
    /// nullptr where the row has nothing there.
    const CsvCell* operator[](CsvColumn column) const {
        const CsvCell* const cell = columns[static_cast<std::size_t>(column)];
        return cell != nullptr && cell->present ? cell : nullptr;
    }
};

/// An error about a column of the current row.
inline tl::unexpected<Error> failCell(const CsvRows& rows, CsvColumn column, std::string cause) {
    return tl::unexpected(rows.about(std::string(csvColumnNames[static_cast<std::size_t>(column)]), std::move(cause)));
}
inline tl::unexpected<Error> failEmpty(const CsvRows& rows, CsvColumn column) {
    return failCell(rows, column, "the cell is empty");
}

/// What names of robots, trajectories, sensors and subjects may be.
bool isCsvName(std::string_view text);
inline constexpr const char* badCsvName = "expected a name of at most 64 printable characters without quotes";

}  // namespace mrose
