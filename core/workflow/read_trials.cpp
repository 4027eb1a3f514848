#include "workflow/read_trials.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "experiment/results_row.h"
#include "io/file.h"

namespace mrose {
namespace {

/// What the first line of a batch or an experiment begins with.
constexpr const char* ofBatch = "trial,seed,end,time_s,touches,kicks,hits,faults,driven_m";
constexpr const char* ofExperiment = "trial,seed,variant,variant_name,end,time_s";

/// Where what is needed of a row stands.
struct Columns {
    std::size_t time = 0, command = 0;
    explicit Columns(const std::vector<std::string>& names)
        : time(static_cast<std::size_t>(std::ranges::find(names, "time_s") - names.begin())),
          command(static_cast<std::size_t>(std::ranges::find(names, "command") - names.begin())) {}
};

/// As a shell takes a line apart that was quoted for it by apostrophes.
std::vector<std::string> wordsOf(const std::string& command) {
    std::vector<std::string> words(1);
    bool quoted = false;
    for (std::size_t i = 0; i < command.size(); ++i) {
        if (command[i] == '\'')
            quoted = !quoted;
        else if (command[i] == '\\' && !quoted && i + 1 < command.size())
            words.back() += command[++i];
        else if (command[i] == ' ' && !quoted)
            words.emplace_back();
        else
            words.back() += command[i];
    }
    return words;
}

/// Where a file lies that a command named, which was typed in a folder that is not known.
std::string found(const std::string& name, const std::filesystem::path& results) {
    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::absolute(results, ignored).parent_path();
    if (std::filesystem::exists(name, ignored)) return name;
    for (; folder.has_relative_path(); folder = folder.parent_path())
        if (std::filesystem::exists(folder / name, ignored)) return (folder / name).string();
    return name;
}

template <class Number>
bool parse(const std::string& text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

std::optional<TrialRow> rowOf(std::vector<std::string> cells, const Columns& columns, const std::string& path) {
    TrialRow row;
    std::uint64_t seed = 0;
    if (cells.size() <= std::max(columns.time, columns.command) || !parse(cells[0], row.request.trial) ||
        !parse(cells[1], seed) || !parse(cells[columns.time], row.end))
        return {};
    row.request.seed = seed;
    const std::vector<std::string> words = wordsOf(cells[columns.command]);
    if (words.size() < 3 || words[1] != "run") return {};
    row.request.file = found(words[2], path);
    for (std::size_t i = 3; i + 1 < words.size(); ++i) {
        if (words[i] == "--log") row.request.log = found(words[i + 1], path);
        if (words[i] == "--variant") row.request.variant = words[i + 1];
        if (words[i] == "--settings") row.request.settings.push_back(found(words[i + 1], path));
        if (words[i] == "--set") row.request.overrides.push_back(words[i + 1]);
    }
    row.cells = std::move(cells);
    return row;
}

}  // namespace

Expected<TrialTable> readTrials(const std::string& path) {
    const auto text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    if (!text->starts_with(ofBatch) && !text->starts_with(ofExperiment))
        return fail(path, "is no results.csv of mrose batch or experiment", 1);
    TrialTable table;
    std::optional<Columns> columns;
    int line = 0;
    for (std::size_t begin = 0; begin < text->size();) {
        const std::size_t end = std::min(text->find('\n', begin), text->size());
        std::vector<std::string> cells = resultsCells(std::string_view(*text).substr(begin, end - begin));
        begin = end + 1;
        if (++line == 1) {
            columns.emplace(cells);
            table.columns = std::move(cells);
            continue;
        }
        // A table is as wide as its first line: no row is filled up to that.
        auto row = cells.size() == table.columns.size() ? rowOf(std::move(cells), *columns, path) : std::nullopt;
        if (!row) return fail(path, "is no row of a batch; expected trial, seed and the command that runs it", line);
        table.rows.push_back(std::move(*row));
    }
    if (table.rows.empty()) return fail(path, "holds no runs");
    return table;
}

}  // namespace mrose
