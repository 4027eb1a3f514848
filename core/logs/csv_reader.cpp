#include "logs/csv_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <set>

#include "io/file.h"
#include "logs/csv_channels.h"
#include "logs/csv_clocks.h"
#include "logs/csv_rows.h"
#include "logs/csv_sensors.h"
#include "logs/row_check.h"

namespace mrose {
namespace {

struct CsvTrajectory {
    std::string name;
    int group = 0;
    CsvChannels channels;
    CsvSensors sensors;
    std::vector<FileTimes> times;  ///< of the files that its rows come from

    void addTime(Nanoseconds time, const std::string& file) {
        if (times.empty() || times.back().file != file) times.push_back({file, time, time});
        times.back().first = std::min(times.back().first, time);
        times.back().last = std::max(times.back().last, time);
    }
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
    constexpr std::array texts = {CsvColumn::robot, CsvColumn::trajectory, CsvColumn::sensor, CsvColumn::subject,
                                  CsvColumn::scan};
    return std::find(texts.begin(), texts.end(), column) != texts.end() ? CellKind::text : CellKind::number;
}

/// All files of one log while they are read.
class CsvLog {
public:
    /// `several`: files, of which one may be empty.
    explicit CsvLog(bool several = false) : several_(several) {}

    Expected<void> addFile(std::string_view content, const std::string& name);
    Expected<Log> finish(const std::string& source, const LogOptions& options);

private:
    Expected<void> addRows(CsvRows& rows, std::string_view content, const std::string& name);
    Expected<void> addRow(const CsvRows& rows, const CsvCells& cells, const std::string& name);
    void checkClocks();
    Expected<void> finishTrajectory(CsvTrajectory& from, RobotLog& log, const LogOptions& options);
    CsvTrajectory& select(std::string_view robot, std::string_view trajectory);

    std::deque<CsvRobot> robots_;
    CsvRobot* robot_ = nullptr;  // of the row before
    CsvTrajectory* trajectory_ = nullptr;
    CsvSubjects subjects_;
    std::size_t rows_ = 0;  // with a time
    std::size_t drivenRows_ = 0, measuredRows_ = 0;
    bool several_;
    Log log_{.format = "csv"};
};

constexpr std::array measurementColumns = {
    CsvColumn::range,           CsvColumn::bearing,   CsvColumn::reportedX, CsvColumn::reportedY,
    CsvColumn::reportedHeading, CsvColumn::scanStart, CsvColumn::scanStep,  CsvColumn::scan};

Expected<void> checkHeader(const CsvRows& rows, const std::string& name) {
    std::set<std::string_view> seen;
    for (const std::string_view column : rows.header()) {
        if (columnOf(column) == noColumn)
            return fail(name, "unknown column; known are " + knownColumns(), rows.headerLine(),
                        quoted(column, column.data(), ",\r\n"));
        if (!seen.insert(column).second)
            return fail(name, "column named twice", rows.headerLine(), std::string(column));
    }
    const auto isThere = [&](CsvColumn column) { return seen.contains(csvColumnNames[std::size_t(column)]); };
    const auto missing = [&](CsvColumn column) {
        return fail(name, "column missing from the header", rows.headerLine(),
                    std::string(csvColumnNames[std::size_t(column)]));
    };
    if (!isThere(CsvColumn::sensor) && std::any_of(measurementColumns.begin(), measurementColumns.end(), isThere))
        return missing(CsvColumn::sensor);
    const bool ofSubjects = isThere(CsvColumn::subject) && !isThere(CsvColumn::sensor);
    if (!isThere(CsvColumn::time) && !ofSubjects) return missing(CsvColumn::time);
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
    CsvCells bound;
    for (std::size_t i = 0; i < rows.header().size(); ++i) bound.columns[columnOf(rows.header()[i])] = &rows.cells()[i];
    return bound;
}

Expected<void> CsvLog::addFile(std::string_view content, const std::string& name) {
    auto rows = CsvRows::open(content, name);
    if (!rows && !several_) return tl::unexpected(rows.error());
    const std::size_t drivenBefore = drivenRows_, measuredBefore = measuredRows_;
    if (!rows)
        log_.incomplete.push_back(tooShortText(name, 0) + '.');
    else if (auto added = addRows(*rows, content, name); !added)
        return added;
    const bool measuredAlone = drivenRows_ == drivenBefore && measuredRows_ > measuredBefore;
    (measuredAlone ? log_.measurementFiles : log_.files).push_back({name, contentHash(content)});
    return {};
}

Expected<void> CsvLog::addRows(CsvRows& rows, std::string_view content, const std::string& name) {
    if (auto checked = checkHeader(rows, name); !checked) return checked;
    log_.synthetic = log_.synthetic || isSynthetic(rows.preamble());
    const CsvCells cells = bindCells(rows);
    const std::size_t before = rows_, measuredBefore = measuredRows_;
    while (rows.next())
        if (auto added = addRow(rows, cells, name); !added) return added;
    if (rows.error() && !rows.cutOff()) return tl::unexpected(*rows.error());
    if (rows.cutOff()) log_.incomplete.push_back(cutLineText(name));
    if (rows.cutOff() && robot_ != nullptr) ++robot_->defects.cutLines;
    if (rows_ == before && measuredRows_ == measuredBefore && several_)
        log_.incomplete.push_back(tooShortText(name, 0) + '.');
    if (rows_ - before < fewestRows && !several_) return fail(name, tooShortCause(rows_ - before));
    for (CsvRobot& robot : robots_)
        for (CsvTrajectory& trajectory : robot.trajectories) {
            if (auto ended = endFile(trajectory.channels, content, name, robot.defects); !ended) return ended;
            if (auto ended = trajectory.sensors.endFile(content, name); !ended) return ended;
        }
    return {};
}

Expected<void> CsvLog::addRow(const CsvRows& rows, const CsvCells& cells, const std::string& name) {
    if (cells[CsvColumn::time] == nullptr) return ++measuredRows_, subjects_.declare(rows, cells);
    for (const CsvColumn column : {CsvColumn::robot, CsvColumn::trajectory, CsvColumn::group})
        if (cells.hasColumn(column) && cells[column] == nullptr) return failEmpty(rows, column);
    const auto nameIn = [&](CsvColumn column, std::string_view usual) {
        const CsvCell* const cell = cells[column];
        return cell != nullptr ? cell->text : usual;
    };
    const std::string_view robot = nameIn(CsvColumn::robot, defaultRobot);
    const std::string_view run = nameIn(CsvColumn::trajectory, defaultTrajectory);
    if (!isCsvName(robot)) return failCell(rows, CsvColumn::robot, badCsvName);
    if (!isCsvName(run)) return failCell(rows, CsvColumn::trajectory, badCsvName);
    CsvTrajectory& trajectory = select(robot, run);
    if (const CsvCell* const cell = cells[CsvColumn::group]) {
        if (cell->number != std::floor(cell->number) || std::abs(cell->number) > 1e9)
            return failCell(rows, CsvColumn::group, "expected a whole number of at most nine digits");
        trajectory.group = static_cast<int>(cell->number);
    }
    ++rows_;
    trajectory.addTime(cells[CsvColumn::time]->instant, name);
    const auto driven = trajectory.channels.add(rows, cells);
    if (!driven) return tl::unexpected(driven.error());
    drivenRows_ += *driven;
    if (cells[CsvColumn::sensor] == nullptr)
        return hasReport(cells) ? Expected<void>(failEmpty(rows, CsvColumn::sensor)) : Expected<void>();
    ++measuredRows_;
    return trajectory.sensors.add(rows, cells, subjects_, name);
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

Expected<void> CsvLog::finishTrajectory(CsvTrajectory& from, RobotLog& log, const LogOptions& options) {
    Trajectory& trajectory = log.trajectories.emplace_back();
    trajectory.name = from.name;
    trajectory.group = from.group;
    merge(from.channels, options, trajectory, log.defects);
    if (trajectory.commands.empty() && trajectory.poses.empty() && trajectory.ball.empty())
        return fail(log_.source, "robot " + log.robot + ", trajectory " + from.name +
                                     ": neither a command (v_cmd and w_cmd) nor a pose (x, y and heading) nor the ball "
                                     "(ball_x and ball_y)");
    return from.sensors.finish(trajectory, options);
}

/// Trajectories of one name are of one session, with one clock.
void CsvLog::checkClocks() {
    std::map<std::string, std::map<std::string, FileTimes>> sessions;
    for (const CsvRobot& robot : robots_)
        for (const CsvTrajectory& trajectory : robot.trajectories)
            for (const FileTimes& times : trajectory.times) {
                FileTimes& ofFile = sessions[trajectory.name].emplace(times.file, times).first->second;
                ofFile.first = std::min(ofFile.first, times.first);
                ofFile.last = std::max(ofFile.last, times.last);
            }
    for (const auto& [name, byFile] : sessions) {
        std::vector<FileTimes> files;
        for (const auto& [file, times] : byFile) files.push_back(times);
        if (std::string text = otherClockText(std::move(files)); !text.empty())
            log_.incomplete.push_back(std::move(text));
    }
}

Expected<Log> CsvLog::finish(const std::string& source, const LogOptions& options) {
    log_.source = source;
    if (rows_ < fewestRows) return fail(source, tooShortCause(rows_));
    for (CsvRobot& robot : robots_) {
        RobotLog& log = log_.robots.emplace_back(RobotLog{robot.name, {}, robot.defects});
        for (CsvTrajectory& from : robot.trajectories)
            if (auto finished = finishTrajectory(from, log, options); !finished)
                return tl::unexpected(finished.error());
    }
    checkClocks();
    log_.subjects = subjects_.finish(log_.robots, log_.incomplete);
    return std::move(log_);
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
    const auto files = csvFiles(source);
    CsvLog csv(files.size() > 1);
    if (files.empty()) return fail(source.string(), "holds no *.csv");
    for (const std::filesystem::path& file : files) {
        const auto content = readFile(file);
        if (!content) return tl::unexpected(content.error());
        if (auto added = csv.addFile(*content, file.string()); !added) return tl::unexpected(added.error());
    }
    return csv.finish(source.string(), options);
}

Expected<Log> parseCsv(std::string_view content, const std::string& name, const LogOptions& options) {
    CsvLog csv;
    if (auto added = csv.addFile(content, name); !added) return tl::unexpected(added.error());
    return csv.finish(name, options);
}

bool looksLikeCsvLog(std::string_view content) {
    const std::string name;
    const auto rows = CsvRows::open(content, name);
    if (!rows) return false;
    const auto& header = rows->header();
    return std::find(header.begin(), header.end(), "t") != header.end();
}

}  // namespace mrose
