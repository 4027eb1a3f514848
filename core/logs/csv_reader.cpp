#include "logs/csv_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <set>

#include "io/file.h"
#include "logs/csv_channels.h"
#include "logs/csv_rows.h"
#include "logs/row_check.h"

namespace mrose {
namespace {

struct CsvTrajectory {
    std::string name;
    int group = 0;
    CsvChannels channels;
};

struct CsvRobot {
    std::string name;
    std::deque<CsvTrajectory> trajectories;
    LogDefects defects;
};

constexpr std::size_t noColumn = csvColumnNames.size();

std::size_t columnOf(std::string_view name) {
    return static_cast<std::size_t>(std::find(csvColumnNames.begin(), csvColumnNames.end(), name) -
                                    csvColumnNames.begin());
}

std::string knownColumns() {
    std::string text;
    for (const std::string_view name : csvColumnNames) text.append(text.empty() ? "" : ", ").append(name);
    return text;
}

constexpr CellKind kindOf(CsvColumn column) {
    if (column == CsvColumn::time) return CellKind::instant;
    return column == CsvColumn::robot || column == CsvColumn::trajectory ? CellKind::text : CellKind::number;
}

constexpr const char* badNameCause = "expected a name of at most 64 printable characters without quotes";

bool isName(std::string_view text) {
    const auto isBad = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f' || c == '"'; };
    return text.size() <= 64 && std::none_of(text.begin(), text.end(), isBad);
}

/// Which cell of a row holds which column; nullptr where the file has none.
struct CsvCells {
    std::array<const CsvCell*, csvChannels> channels{};
    const CsvCell *time = nullptr, *robot = nullptr, *trajectory = nullptr, *group = nullptr;
};

/// All files of one log while they are read.
class CsvLog {
public:
    /// `several`: files, of which one may be empty.
    explicit CsvLog(bool several = false) : several_(several) {}

    Expected<void> addFile(std::string_view content, const std::string& name);
    Expected<std::vector<RobotLog>> finish(const std::string& source, const LogOptions& options);
    bool synthetic() const { return synthetic_; }
    const std::vector<std::string>& incomplete() const { return incomplete_; }

private:
    Expected<void> addRow(const CsvRows& rows, const CsvCells& cells);
    CsvTrajectory& select(std::string_view robot, std::string_view trajectory);

    std::deque<CsvRobot> robots_;
    CsvRobot* robot_ = nullptr;  // of the row before
    CsvTrajectory* trajectory_ = nullptr;
    std::size_t rows_ = 0;
    bool several_, synthetic_ = false;
    std::vector<std::string> incomplete_;
};

Expected<void> checkHeader(const CsvRows& rows, const std::string& name) {
    std::set<std::string_view> seen;
    for (const std::string_view column : rows.header()) {
        if (columnOf(column) == noColumn)
            return fail(name, "unknown column; known are " + knownColumns(), rows.headerLine(),
                        quoted(column, column.data(), ",\r\n"));
        if (!seen.insert(column).second)
            return fail(name, "column named twice", rows.headerLine(), std::string(column));
    }
    if (!seen.contains("t")) return fail(name, "column missing from the header", rows.headerLine(), "t");
    return {};
}

bool isSynthetic(std::string_view preamble) {
    return preamble.starts_with(syntheticMark) ||
           preamble.find('\n' + std::string(syntheticMark)) != std::string_view::npos;
}

CsvCells bindCells(CsvRows& rows) {
    std::vector<CellKind> kinds;
    for (const std::string_view name : rows.header()) kinds.push_back(kindOf(CsvColumn(columnOf(name))));
    rows.setKinds(std::move(kinds));
    std::array<const CsvCell*, csvColumnNames.size()> cells{};
    for (std::size_t i = 0; i < rows.header().size(); ++i) cells[columnOf(rows.header()[i])] = &rows.cells()[i];
    CsvCells bound;
    std::copy_n(cells.begin(), csvChannels, bound.channels.begin());
    bound.time = cells[std::size_t(CsvColumn::time)];
    bound.robot = cells[std::size_t(CsvColumn::robot)];
    bound.trajectory = cells[std::size_t(CsvColumn::trajectory)];
    bound.group = cells[std::size_t(CsvColumn::group)];
    return bound;
}

Expected<void> CsvLog::addFile(std::string_view content, const std::string& name) {
    auto rows = CsvRows::open(content, name);
    if (!rows && several_) return incomplete_.push_back(tooShortText(name, 0) + '.'), Expected<void>();
    if (!rows) return tl::unexpected(rows.error());
    if (auto checked = checkHeader(*rows, name); !checked) return checked;
    synthetic_ = synthetic_ || isSynthetic(rows->preamble());
    const CsvCells cells = bindCells(*rows);
    const std::size_t before = rows_;
    for (; rows->next(); ++rows_)
        if (auto added = addRow(*rows, cells); !added) return added;
    if (rows->error() && !rows->cutOff()) return tl::unexpected(*rows->error());
    if (rows->cutOff()) incomplete_.push_back(cutLineText(name));
    if (rows->cutOff() && robot_ != nullptr) ++robot_->defects.cutLines;
    if (rows_ == before && several_) incomplete_.push_back(tooShortText(name, 0) + '.');
    if (rows_ - before < fewestRows && !several_) return fail(name, tooShortCause(rows_ - before));
    for (CsvRobot& robot : robots_)
        for (CsvTrajectory& trajectory : robot.trajectories)
            if (auto ended = endFile(trajectory.channels, content, name, robot.defects); !ended) return ended;
    return {};
}

Expected<void> CsvLog::addRow(const CsvRows& rows, const CsvCells& cells) {
    const auto missing = [&](CsvColumn column) {
        return tl::unexpected(rows.about(std::string(csvColumnNames[std::size_t(column)]), "the cell is empty"));
    };
    if (!cells.time->present) return missing(CsvColumn::time);
    if (cells.robot != nullptr && !cells.robot->present) return missing(CsvColumn::robot);
    if (cells.trajectory != nullptr && !cells.trajectory->present) return missing(CsvColumn::trajectory);
    if (cells.group != nullptr && !cells.group->present) return missing(CsvColumn::group);
    const std::string_view robot = cells.robot == nullptr ? defaultRobot : cells.robot->text;
    const std::string_view name = cells.trajectory == nullptr ? defaultTrajectory : cells.trajectory->text;
    if (!isName(robot)) return tl::unexpected(rows.about("robot", badNameCause));
    if (!isName(name)) return tl::unexpected(rows.about("trajectory", badNameCause));
    CsvTrajectory& trajectory = select(robot, name);
    if (cells.group != nullptr) {
        const double group = cells.group->number;
        if (group != std::floor(group) || std::abs(group) > 1e9)
            return tl::unexpected(rows.about("group", "expected a whole number of at most nine digits"));
        trajectory.group = static_cast<int>(group);
    }
    trajectory.channels.add(cells.time->instant, cells.channels, rows.position());
    return {};
}

CsvTrajectory& CsvLog::select(std::string_view robot, std::string_view trajectory) {
    const auto isNamed = [](std::string_view name) { return [name](const auto& item) { return item.name == name; }; };
    if (robot_ == nullptr || robot_->name != robot) {
        auto found = std::find_if(robots_.begin(), robots_.end(), isNamed(robot));
        if (found == robots_.end()) found = robots_.insert(found, CsvRobot{std::string(robot), {}, {}});
        robot_ = &*found;
        trajectory_ = nullptr;
    }
    if (trajectory_ == nullptr || trajectory_->name != trajectory) {
        auto& known = robot_->trajectories;
        auto found = std::find_if(known.begin(), known.end(), isNamed(trajectory));
        if (found == known.end())
            found = known.insert(found, CsvTrajectory{std::string(trajectory), static_cast<int>(known.size()), {}});
        trajectory_ = &*found;
    }
    return *trajectory_;
}

Expected<std::vector<RobotLog>> CsvLog::finish(const std::string& source, const LogOptions& options) {
    if (rows_ < fewestRows) return fail(source, tooShortCause(rows_));
    std::vector<RobotLog> logs;
    for (CsvRobot& robot : robots_) {
        RobotLog& log = logs.emplace_back(RobotLog{robot.name, {}, robot.defects});
        for (CsvTrajectory& from : robot.trajectories) {
            Trajectory& trajectory = log.trajectories.emplace_back();
            trajectory.name = from.name;
            trajectory.group = from.group;
            merge(from.channels, options, trajectory, log.defects);
            if (trajectory.commands.empty() && trajectory.poses.empty())
                return fail(source, "robot " + robot.name + ", trajectory " + from.name +
                                        ": neither a command (v_cmd and w_cmd) nor a pose (x, y and heading)");
        }
    }
    return logs;
}

std::vector<std::filesystem::path> csvFiles(const std::filesystem::path& source) {
    if (!std::filesystem::is_directory(source)) return {source};
    std::vector<std::filesystem::path> files;
    std::error_code ignored;
    for (std::filesystem::directory_iterator entry(source, ignored), end; !ignored && entry != end;
         entry.increment(ignored))
        if (entry->path().extension() == ".csv") files.push_back(entry->path());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

Expected<Log> readCsv(const std::filesystem::path& source, const LogOptions& options) {
    Log log{source.string(), "csv", 0, {}, {}, false};
    const auto files = csvFiles(source);
    CsvLog csv(files.size() > 1);
    if (files.empty()) return fail(source.string(), "holds no *.csv");
    for (const std::filesystem::path& file : files) {
        const auto content = readFile(file);
        if (!content) return tl::unexpected(content.error());
        log.files.push_back({file.string(), contentHash(*content)});
        if (auto added = csv.addFile(*content, file.string()); !added) return tl::unexpected(added.error());
    }
    auto robots = csv.finish(log.source, options);
    if (!robots) return tl::unexpected(robots.error());
    log.robots = std::move(*robots);
    log.synthetic = csv.synthetic();
    log.incomplete = csv.incomplete();
    return log;
}

Expected<Log> parseCsv(std::string_view content, const std::string& name, const LogOptions& options) {
    CsvLog csv;
    if (auto added = csv.addFile(content, name); !added) return tl::unexpected(added.error());
    auto robots = csv.finish(name, options);
    if (!robots) return tl::unexpected(robots.error());
    return Log{name, "csv", 0, std::move(*robots), {{name, contentHash(content)}}, csv.synthetic(), csv.incomplete()};
}

bool looksLikeCsvLog(std::string_view content) {
    const std::string name;
    const auto rows = CsvRows::open(content, name);
    if (!rows) return false;
    const auto& header = rows->header();
    return std::find(header.begin(), header.end(), "t") != header.end();
}

}  // namespace mrose
