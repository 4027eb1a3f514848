#include "experiment/results_table.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "experiment/results_row.h"
#include "io/file.h"

namespace mrose {

std::size_t ResultsTable::columnOf(std::string_view name) const {
    return static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
}

double ResultsTable::number(std::size_t row, std::size_t column) const {
    const std::string& cell = rows[row][column];
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    const bool whole = error == std::errc() && end == cell.data() + cell.size();
    return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

Expected<ResultsTable> readResultsTable(const std::filesystem::path& place) {
    std::error_code ignored;
    const auto path = std::filesystem::is_directory(place, ignored) ? place / "results.csv" : place;
    const auto text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    if (!text->starts_with("trial,seed,")) return fail(path.string(), "is no results.csv of mrose", 1);
    ResultsTable table{path.string(), {}, {}};
    for (std::string_view rest = *text; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::vector<std::string> cells = resultsCells(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (table.columns.empty()) {
            table.columns = std::move(cells);
            continue;
        }
        if (cells.size() != table.columns.size())
            return fail(
                table.file,
                "has " + std::to_string(cells.size()) + " cells; expected " + std::to_string(table.columns.size()),
                static_cast<int>(table.rows.size()) + 2);
        table.rows.push_back(std::move(cells));
    }
    return table;
}

}  // namespace mrose
