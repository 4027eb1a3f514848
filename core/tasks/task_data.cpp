#include "tasks/task_data.h"

#include <algorithm>
#include <cmath>

#include "experiment/run.h"

namespace mrose {
namespace {

constexpr std::string_view ofFeature = "feature.", ofMeasure = "measure.", ofDraw = "draw.";

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

Expected<std::size_t> columnOf(const ResultsTable& table, std::string_view kind, const std::string& name,
                               const char* flag) {
    const bool draw = kind == ofFeature && name.starts_with(ofDraw);
    const std::size_t column = table.columnOf(draw ? name : std::string(kind) + name);
    if (column < table.columns.size()) return column;
    return fail(table.file,
                "has no " + std::string(kind.substr(0, kind.size() - 1)) + " \"" + name + "\"; it has " +
                    listed(namesOf(table, kind)),
                0, flag);
}

}  // namespace

TaskData TaskData::part(int every, int offset, bool heldOut) const {
    TaskData part{inputs, target, {}, {}, {}, {}};
    for (const Guess& guess : beside) part.beside.push_back({guess.name, {}});
    for (std::size_t row = 0; row < rows(); ++row) {
        if ((static_cast<int>(trial[row] % static_cast<std::uint32_t>(every)) == offset) != heldOut) continue;
        part.x.insert(part.x.end(), inputsOf(row), inputsOf(row) + inputs.size());
        part.y.push_back(y[row]);
        part.trial.push_back(trial[row]);
        for (std::size_t k = 0; k < beside.size(); ++k) part.beside[k].of.push_back(beside[k].of[row]);
    }
    return part;
}

Expected<TaskData> taskData(const ResultsTable& table, const TaskQuestion& question) {
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
    const std::size_t end = table.columnOf("end"), trial = table.columnOf("trial");
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
    }
    if (data.rows() == 0)
        return fail(table.file, "has no row to learn from: " + std::to_string(data.unfinished) +
                                    " not ended by `until`, " + std::to_string(data.faulty) + " by a fault, " +
                                    std::to_string(data.unknown) + " without numbers");
    return data;
}

}  // namespace mrose
