#include "tasks/task_data.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "experiment/run.h"

namespace mrose {
namespace {

constexpr std::string_view ofFeature = "feature.", ofMeasure = "measure.", ofDraw = "draw.", ofSweep = "swept";

/// What columns that begin so are called.
std::vector<std::string> namesOf(const ResultsTable& table, std::string_view beginning) {
    std::vector<std::string> names;
    for (const std::string& column : table.columns)
        if (column.starts_with(beginning)) names.push_back(column.substr(beginning.size()));
    return names;
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "none" : text;
}

/// Error: a name is there twice, as an input or beside what is learned.
Expected<void> namedOnce(const TaskQuestion& question) {
    std::set<std::string_view> seen;
    for (const std::string& name : question.inputs)
        if (!seen.insert(name).second) return fail("", "names \"" + name + "\" twice", 0, "--inputs");
    for (const std::string& name : question.beside)
        if (!seen.insert(name).second)
            return fail("",
                        "names \"" + name + "\"" +
                            (std::ranges::find(question.inputs, name) != question.inputs.end()
                                 ? ", an input (--inputs); expected features that are none"
                                 : " twice"),
                        0, "--beside");
    return {};
}

Expected<std::size_t> columnOf(const ResultsTable& table, std::string_view kind, const std::string& name,
                               const char* flag) {
    const bool whole = kind == ofFeature && (name.starts_with(ofDraw) || name == ofSweep);
    const std::size_t column = table.columnOf(whole ? name : std::string(kind) + name);
    if (column < table.columns.size()) return column;
    return fail(table.file,
                "has no " + std::string(kind.substr(0, kind.size() - 1)) + " \"" + name + "\"; it has " +
                    listed(namesOf(table, kind)),
                0, flag);
}

/// Which variant and which run of its trial each row is of.
struct RunsTable {
    std::vector<std::string> variants;
    std::size_t seeds = 0;                       ///< runs of a trial
    std::vector<std::size_t> variantOf, seedOf;  ///< [row]
};
RunsTable runsOf(const ResultsTable& table) {
    RunsTable runs;
    const std::size_t number = table.columnOf("variant"), called = table.columnOf("variant_name");
    const std::size_t seed = table.columnOf("seed"), trial = table.columnOf("trial");
    std::vector<std::string> numbers;
    std::map<std::string, std::vector<std::string>> seedsOf;  // by trial
    const auto indexOf = [](std::vector<std::string>& known, const std::string& one) {
        const auto at = std::ranges::find(known, one);
        if (at != known.end()) return static_cast<std::size_t>(at - known.begin());
        known.push_back(one);
        return known.size() - 1;
    };
    for (const std::vector<std::string>& row : table.rows) {
        const std::size_t variant = indexOf(numbers, row[number]);
        if (variant == runs.variants.size()) runs.variants.push_back(row[called]);
        runs.variantOf.push_back(variant);
        runs.seedOf.push_back(indexOf(seedsOf[row[trial]], row[seed]));
        runs.seeds = std::max(runs.seeds, runs.seedOf.back() + 1);
    }
    return runs;
}

/// Rows that are runs, made rows that are trials.
Expected<TaskData> byVariant(TaskData of, const std::vector<std::size_t>& kept, const ResultsTable& table) {
    const RunsTable runs = runsOf(table);
    const std::size_t variants = runs.variants.size(), seeds = runs.seeds, width = of.inputs.size();
    if (variants < 2)
        return fail(table.file, "has one variant alone; expected several to choose from", 0, "--by-variant");
    struct Cells {
        std::vector<double> x, y;
        std::vector<std::string> window;  // by variant
        std::size_t known = 0;
    };
    std::map<std::uint32_t, Cells> trials;
    const std::size_t trial = table.columnOf("trial");
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        trials[static_cast<std::uint32_t>(table.number(row, trial))].y.assign(seeds * variants, 0);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        Cells& cells = trials[of.trial[i]];
        if (cells.x.empty()) cells.x.assign(of.inputsOf(i), of.inputsOf(i) + width);
        cells.window.resize(variants);
        if (std::string& window = cells.window[runs.variantOf[kept[i]]]; window.empty()) window = of.window[i];
        cells.y[runs.seedOf[kept[i]] * variants + runs.variantOf[kept[i]]] = of.y[i];
        ++cells.known;
    }
    TaskData data{.inputs = std::move(of.inputs), .target = std::move(of.target), .variants = runs.variants};
    data.seeds = seeds;
    data.unfinished = of.unfinished, data.faulty = of.faulty;
    for (const auto& [number, cells] : trials) {
        if (cells.known != seeds * variants) {
            ++data.unknown;
            continue;
        }
        data.trial.push_back(number);
        data.window.insert(data.window.end(), cells.window.begin(), cells.window.end());
        data.x.insert(data.x.end(), cells.x.begin(), cells.x.end());
        data.bySeed.insert(data.bySeed.end(), cells.y.begin(), cells.y.end());
        for (std::size_t variant = 0; variant < variants; ++variant) {
            double sum = 0;
            for (std::size_t seed = 0; seed < seeds; ++seed) sum += cells.y[seed * variants + variant];
            data.y.push_back(sum / static_cast<double>(seeds));
        }
    }
    return data;
}

}  // namespace

TaskData TaskData::part(int every, int offset, bool heldOut) const {
    TaskData part{.inputs = inputs, .target = target, .variants = variants};
    part.seeds = seeds;
    for (const Guess& guess : beside) part.beside.push_back({guess.name, {}});
    const auto take = [](const std::vector<double>& from, std::size_t row, std::size_t width, std::vector<double>& to) {
        const auto first = from.begin() + static_cast<std::ptrdiff_t>(row * width);
        to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(width));
    };
    for (std::size_t row = 0; row < rows(); ++row) {
        if ((static_cast<int>(trial[row] % static_cast<std::uint32_t>(every)) == offset) != heldOut) continue;
        take(x, row, inputs.size(), part.x);
        take(y, row, outputs(), part.y);
        if (!variants.empty()) take(bySeed, row, seeds * variants.size(), part.bySeed);
        part.trial.push_back(trial[row]);
        for (std::size_t k = 0; k < outputs() && !window.empty(); ++k)
            part.window.push_back(window[row * outputs() + k]);
        for (std::size_t k = 0; k < beside.size(); ++k) part.beside[k].of.push_back(beside[k].of[row]);
    }
    return part;
}

Expected<TaskData> taskData(const ResultsTable& table, const TaskQuestion& question) {
    if (const auto once = namedOnce(question); !once) return tl::unexpected(once.error());
    TaskData data;
    data.target = question.target;
    data.inputs = question.inputs;
    if (data.inputs.empty())
        for (const std::string& name : namesOf(table, ofFeature))
            if (std::ranges::find(question.beside, name) == question.beside.end()) data.inputs.push_back(name);
    if (data.inputs.empty()) return fail(table.file, "has no features to learn from");
    const auto target = columnOf(table, ofMeasure, question.target, "--target");
    if (!target) return tl::unexpected(target.error());
    const auto columnsOf = [&](const std::vector<std::string>& names,
                               const char* flag) -> Expected<std::vector<std::size_t>> {
        std::vector<std::size_t> columns;
        for (const std::string& name : names) {
            const auto column = columnOf(table, ofFeature, name, flag);
            if (!column) return tl::unexpected(column.error());
            columns.push_back(*column);
        }
        return columns;
    };
    const auto inputs = columnsOf(data.inputs, "--inputs"), beside = columnsOf(question.beside, "--beside");
    if (!inputs) return tl::unexpected(inputs.error());
    if (!beside) return tl::unexpected(beside.error());
    for (const std::string& name : question.beside) data.beside.push_back({name, {}});
    std::vector<std::size_t> kept;
    const std::size_t end = table.columnOf("end"), trial = table.columnOf("trial"), window = table.columnOf("window");
    // Without `until` all last as long.
    const bool ends =
        std::ranges::any_of(table.rows, [&](const auto& row) { return row[end] == name(RunEnd::condition); });
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        if (table.rows[row][end] == name(RunEnd::fault)) {
            ++data.faulty;
            continue;
        }
        if (ends && !question.unfinished && table.rows[row][end] != name(RunEnd::condition)) {
            ++data.unfinished;
            continue;
        }
        const double y = table.number(row, *target);
        bool known = std::isfinite(y);
        for (const std::size_t column : *inputs) known = known && std::isfinite(table.number(row, column));
        if (!known) {
            ++data.unknown;
            continue;
        }
        for (const std::size_t column : *inputs) data.x.push_back(table.number(row, column));
        for (std::size_t k = 0; k < beside->size(); ++k) data.beside[k].of.push_back(table.number(row, (*beside)[k]));
        data.y.push_back(y);
        data.trial.push_back(static_cast<std::uint32_t>(table.number(row, trial)));
        data.window.push_back(window < table.columns.size() ? table.rows[row][window] : "");
        kept.push_back(row);
    }
    if (question.byVariant) {
        auto chosen = byVariant(std::move(data), kept, table);
        if (!chosen) return chosen;
        data = std::move(*chosen);
    }
    if (data.rows() == 0)
        return fail(table.file, "has no row to learn from: " + std::to_string(data.unfinished) +
                                    " not ended by `until`, " + std::to_string(data.faulty) + " by a fault, " +
                                    std::to_string(data.unknown) + (question.byVariant ? " trials" : "") +
                                    " without numbers");
    return data;
}

}  // namespace mrose
