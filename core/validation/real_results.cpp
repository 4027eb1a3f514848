#include "validation/real_results.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "experiment/results_row.h"

namespace mrose {
namespace {

constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();

template <class Number>
bool parsed(const std::string& cell, Number& number) {
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    return error == std::errc() && end == cell.data() + cell.size();
}

constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

/// Without blanks around them.
std::vector<std::string> trimmedCells(std::string_view line) {
    constexpr const char* blanks = " \t\r";
    std::vector<std::string> cells = resultsCells(line);
    for (std::string& cell : cells) {
        cell.erase(cell.find_last_not_of(blanks) + 1);
        cell.erase(0, std::min(cell.find_first_not_of(blanks), cell.size()));
    }
    return cells;
}

/// Sums of what was measured of one trial.
struct RealSums {
    std::vector<double> sum, count;

    void add(std::size_t measure, std::size_t measures, double value) {
        sum.resize(measures), count.resize(measures);
        if (!std::isfinite(value)) return;
        sum[measure] += value, count[measure] += 1;
    }
    std::vector<double> means() const {
        std::vector<double> means;
        for (std::size_t i = 0; i < sum.size(); ++i) means.push_back(count[i] > 0 ? sum[i] / count[i] : notKnown);
        return means;
    }
};

}  // namespace

Expected<RealResults> readRealResults(std::string_view text, const std::string& file,
                                      const std::vector<std::string>& measures) {
    std::map<std::uint32_t, std::array<RealSums, 2>> sums;
    std::vector<std::string> header;
    std::vector<std::size_t> columns;  // of trial, when and the measures
    int line = 0;
    if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view one = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++line;
        const std::vector<std::string> cells = trimmedCells(one);
        if (std::ranges::all_of(cells, [](const std::string& cell) { return cell.empty(); })) continue;
        if (header.empty()) {
            header = cells;
            std::vector<std::string> wanted{"trial", "when"};
            wanted.insert(wanted.end(), measures.begin(), measures.end());
            for (const std::string& name : wanted) {
                const auto found = std::ranges::find(header, name);
                if (found == header.end())
                    return fail(file, "has no column \"" + name + "\"; expected trial, when and the measures", line);
                columns.push_back(static_cast<std::size_t>(found - header.begin()));
            }
            continue;
        }
        if (cells.size() != header.size())
            return fail(file,
                        "has " + std::to_string(cells.size()) + " cells; expected " + std::to_string(header.size()),
                        line);
        std::uint32_t trial = 0;
        if (!parsed(cells[columns[0]], trial) || trial == 0)
            return fail(file, "\"" + cells[columns[0]] + "\" is no trial; expected a whole number from 1 on", line,
                        "trial");
        const std::string& when = cells[columns[1]];
        if (when != "before" && when != "after")
            return fail(file, "is \"" + when + "\"; expected before or after", line, "when");
        for (std::size_t i = 0; i < measures.size(); ++i) {
            const std::string& cell = cells[columns[i + 2]];
            double value = notKnown;
            if (!cell.empty() && !parsed(cell, value))
                return fail(file, "\"" + cell + "\" is no number", line, measures[i]);
            sums[trial][when == "after" ? 1 : 0].add(i, measures.size(), value);
        }
    }
    if (sums.empty()) return fail(file, "holds no results; expected rows of trial, when and the measures");
    RealResults results;
    for (const auto& [trial, both] : sums)
        for (std::size_t i = 0; i < 2; ++i) {
            if (both[i].sum.empty())
                return fail(file,
                            "trial " + std::to_string(trial) + " was not measured " + (i == 0 ? "before" : "after"));
            results[trial][i] = both[i].means();
        }
    return results;
}

}  // namespace mrose
