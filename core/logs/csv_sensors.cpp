#include "logs/csv_sensors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/format.h"

namespace mrose {
namespace {

constexpr std::array reportColumns = {CsvColumn::subject,   CsvColumn::range,     CsvColumn::bearing,
                                      CsvColumn::reportedX, CsvColumn::reportedY, CsvColumn::reportedHeading,
                                      CsvColumn::scanStart, CsvColumn::scanStep,  CsvColumn::scan};

/// Cells that say something together or not at all.
template <std::size_t count>
struct CellGroup {
    std::array<CsvColumn, count> columns;

    bool any(const CsvCells& cells) const {
        return std::any_of(columns.begin(), columns.end(), [&](CsvColumn c) { return cells[c] != nullptr; });
    }
    Expected<void> checkWhole(const CsvRows& rows, const CsvCells& cells) const {
        for (const CsvColumn column : columns)
            if (cells[column] == nullptr) return failEmpty(rows, column);
        return {};
    }
};

constexpr CellGroup<3> readingCells{{CsvColumn::subject, CsvColumn::range, CsvColumn::bearing}};
constexpr CellGroup<3> poseCells{{CsvColumn::reportedX, CsvColumn::reportedY, CsvColumn::reportedHeading}};
constexpr CellGroup<3> scanCells{{CsvColumn::scan, CsvColumn::scanStart, CsvColumn::scanStep}};

Expected<StampedReading> readingOf(const CsvRows& rows, const CsvCells& cells, CsvSubjects& subjects) {
    if (auto whole = readingCells.checkWhole(rows, cells); !whole) return tl::unexpected(whole.error());
    const std::string_view subject = cells[CsvColumn::subject]->text;
    const double range = cells[CsvColumn::range]->number, bearing = cells[CsvColumn::bearing]->number;
    if (!isCsvName(subject)) return failCell(rows, CsvColumn::subject, badCsvName);
    if (const std::string cause = wrongRange(range); !cause.empty()) return failCell(rows, CsvColumn::range, cause);
    if (const std::string cause = wrongBearing(bearing); !cause.empty())
        return failCell(rows, CsvColumn::bearing, cause);
    return StampedReading{cells[CsvColumn::time]->instant, LogReading{subjects.named(subject), range, bearing}};
}

/// The next range of a scan's text; `text` is then what follows it.
std::string_view nextRange(std::string_view& text, bool semicolons) {
    const std::size_t end = text.find_first_of(semicolons ? ";" : " \t");
    std::string_view range = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const auto isBlank = [](char c) { return c == ' ' || c == '\t'; };
    while (!range.empty() && isBlank(range.front())) range.remove_prefix(1);
    while (!range.empty() && isBlank(range.back())) range.remove_suffix(1);
    while (!semicolons && !text.empty() && isBlank(text.front())) text.remove_prefix(1);
    return range;
}

Expected<std::vector<double>> rangesOf(const CsvRows& rows, std::string_view text) {
    const bool semicolons = text.find(';') != std::string_view::npos;
    std::vector<double> ranges;
    for (bool more = true; more;) {
        // A last semicolon has one more range behind it, though nothing is written there.
        const bool last =
            semicolons ? text.find(';') == std::string_view::npos : text.find_first_of(" \t") == std::string_view::npos;
        const std::string_view range = nextRange(text, semicolons);
        more = !last;
        double value = std::numeric_limits<double>::infinity();
        const char* const end = range.data() + range.size();
        if (!range.empty() && range != "inf" && parseSample(range.data(), end, value) != end)
            return failCell(rows, CsvColumn::scan,
                            "expected ranges separated by semicolons, inf or nothing without an echo, found " +
                                quoted(range, range.data(), ";, \t\r\n"));
        if (const std::string cause = wrongRange(value); !cause.empty()) return failCell(rows, CsvColumn::scan, cause);
        ranges.push_back(value);
    }
    return ranges;
}

Expected<LogScan> scanOf(const CsvRows& rows, const CsvCells& cells) {
    if (auto whole = scanCells.checkWhole(rows, cells); !whole) return tl::unexpected(whole.error());
    LogScan scan{
        cells[CsvColumn::time]->instant, cells[CsvColumn::scanStart]->number, cells[CsvColumn::scanStep]->number, {}};
    auto ranges = rangesOf(rows, cells[CsvColumn::scan]->text);
    if (!ranges) return tl::unexpected(ranges.error());
    scan.ranges = std::move(*ranges);
    if (const std::string cause = wrongBearing(scan.start); !cause.empty())
        return failCell(rows, CsvColumn::scanStart, cause);
    const double width = std::abs(scan.step) * static_cast<double>(scan.ranges.size() - 1);
    if (width > 2 * std::numbers::pi + 1e-3)
        return failCell(rows, CsvColumn::scanStep,
                        "expected " + counted(scan.ranges.size(), "ray") + " within a whole turn of 2 pi, found " +
                            numberText(width) + " rad: are these degrees?");
    return scan;
}

}  // namespace

bool isCsvName(std::string_view text) {
    const auto isBad = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f' || c == '"'; };
    return text.size() <= 64 && std::none_of(text.begin(), text.end(), isBad);
}

bool hasReport(const CsvCells& cells) {
    return std::any_of(reportColumns.begin(), reportColumns.end(), [&](CsvColumn c) { return cells[c] != nullptr; });
}

CsvSensors::Sensor& CsvSensors::select(std::string_view name, const CsvRows& rows, const std::string& file) {
    if (sensor_ != nullptr && sensor_->log.sensor == name) return *sensor_;
    auto found =
        std::find_if(sensors_.begin(), sensors_.end(), [&](const Sensor& sensor) { return sensor.log.sensor == name; });
    if (found == sensors_.end()) {
        found = sensors_.insert(found, Sensor{{.sensor = std::string(name)}, {}, {}, {}});
        found->file = file;
        found->line = rows.line();
    }
    sensor_ = &*found;
    return *sensor_;
}

Expected<void> CsvSensors::add(const CsvRows& rows, const CsvCells& cells, CsvSubjects& subjects,
                               const std::string& file) {
    const std::string_view name = cells[CsvColumn::sensor]->text;
    if (!isCsvName(name)) return failCell(rows, CsvColumn::sensor, badCsvName);
    Sensor& sensor = select(name, rows, file);
    const Nanoseconds time = cells[CsvColumn::time]->instant;
    if (readingCells.any(cells)) {
        const auto reading = readingOf(rows, cells, subjects);
        if (!reading) return tl::unexpected(reading.error());
        sensor.readings.add(*reading, rows.position());
    }
    if (poseCells.any(cells)) {
        if (auto whole = poseCells.checkWhole(rows, cells); !whole) return whole;
        const Pose pose{cells[CsvColumn::reportedX]->number, cells[CsvColumn::reportedY]->number,
                        cells[CsvColumn::reportedHeading]->number};
        sensor.poses.add({time, pose}, rows.position());
    }
    if (scanCells.any(cells)) {
        auto scan = scanOf(rows, cells);
        if (!scan) return tl::unexpected(scan.error());
        sensor.scans.add(std::move(*scan), rows.position());
    }
    if (!hasReport(cells)) sensor.readings.add({time, {}}, rows.position());
    return {};
}

Expected<void> CsvSensors::endFile(std::string_view content, const std::string& name) {
    for (Sensor& sensor : sensors_) {
        std::int64_t& outOfOrder = sensor.log.defects.outOfOrder;
        auto ended = mrose::endFile(sensor.readings, content, name, outOfOrder);
        if (ended) ended = mrose::endFile(sensor.poses, content, name, outOfOrder);
        if (ended) ended = mrose::endFile(sensor.scans, content, name, outOfOrder);
        if (!ended) return ended;
    }
    return {};
}

Expected<void> CsvSensors::finish(Trajectory& trajectory, const LogOptions& options) {
    for (Sensor& sensor : sensors_) {
        SensorLog& log = sensor.log;
        log.looks = joinLooks(std::move(sensor.readings.samples), fromSeconds(options.lookSpan), log.defects);
        log.poses = std::move(sensor.poses.samples);
        log.scans = std::move(sensor.scans.samples);
        conditionReported(log.poses, log.defects);
        conditionReported(log.scans, log.defects);
        if (!sharesTime(log, trajectory))
            return fail(sensor.file, "sensor " + log.sensor + ": " + otherTimeCause(log, trajectory), sensor.line, "t");
        trajectory.sensors.push_back(std::move(log));
    }
    return {};
}

}  // namespace mrose
