#include "logs/husky_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/file.h"
#include "logs/conditioning.h"
#include "logs/csv_rows.h"
#include "logs/row_check.h"

namespace mrose {
namespace {

enum Column { window, calibStep, time, commandLeft, commandRight, wheelLeft, wheelRight, x, y, yaw, yawRate, steady };
constexpr std::array<std::string_view, 12> columnNames = {"window",
                                                          "calib_step",
                                                          "t_s",
                                                          "cmd_left_radps",
                                                          "cmd_right_radps",
                                                          "wheel_left_radps",
                                                          "wheel_right_radps",
                                                          "icp_x_m",
                                                          "icp_y_m",
                                                          "icp_yaw_rad",
                                                          "imu_yaw_rad",
                                                          "steady"};

constexpr Nanoseconds longestPast = 4 * nanosecondsPerSecond;
constexpr Nanoseconds longestWindow = 1000 * nanosecondsPerSecond;
constexpr Nanoseconds pause = 10 * nanosecondsPerSecond;
constexpr double continuedWheelStep = 1.5;  // rad/s; 99.7 % of the differences within windows are smaller
constexpr double restingWheel = 0.1;        // rad/s

using Wheels = DifferentialDrive::WheelSpeeds;

struct Row {
    Nanoseconds time = 0;
    Wheels command, wheels;
    Pose pose;
    double yawRate = 0;
    const char* place = nullptr;
};

struct Window {
    int number = 0, step = 0;
    bool isSteady = false;
    bool continues = false;  // the window before, without a pause
    Nanoseconds start = 0;
    std::vector<Row> rows = {};
};

int toInt(double number) { return static_cast<int>(std::clamp(number, -1e9, 1e9)); }

Expected<void> addRow(std::vector<Window>& windows, const CsvRows& rows) {
    const auto cells = rows.cells();
    for (std::size_t i = 0; i < columnNames.size(); ++i)
        if (!cells[i].present) return tl::unexpected(rows.about(std::string(columnNames[i]), "the cell is empty"));
    const int number = toInt(cells[window].number);
    if (windows.empty() || windows.back().number != number)
        windows.push_back(
            {.number = number, .step = toInt(cells[calibStep].number), .isSteady = cells[steady].number != 0});
    windows.back().rows.push_back({cells[time].instant,
                                   {cells[commandLeft].number, cells[commandRight].number},
                                   {cells[wheelLeft].number, cells[wheelRight].number},
                                   {cells[x].number, cells[y].number, cells[yaw].number},
                                   cells[yawRate].number,
                                   rows.position()});
    return {};
}

/// `cutOff`: whether the last line is, which is left out.
Expected<std::vector<Window>> parseWindows(std::string_view content, const std::string& name, bool& cutOff) {
    auto rows = CsvRows::open(content, name);
    if (!rows) return tl::unexpected(rows.error());
    if (!std::equal(rows->header().begin(), rows->header().end(), columnNames.begin(), columnNames.end()))
        return fail(name, "is no header of Husky windows", rows->headerLine());
    std::vector<CellKind> kinds(columnNames.size(), CellKind::number);
    kinds[time] = CellKind::instant;
    rows->setKinds(std::move(kinds));
    std::vector<Window> windows;
    while (rows->next())
        if (auto added = addRow(windows, *rows); !added) return tl::unexpected(added.error());
    cutOff = rows->cutOff();
    if (rows->error() && !cutOff) return tl::unexpected(*rows->error());
    return windows;
}

/// Rows in order and counted from the window's first one. Error: too short, too long, backwards in time for good.
Expected<void> arrange(Window& item, std::string_view content, const std::string& name, LogDefects& defects) {
    const auto lineOf = [&](std::size_t row) { return positionIn(content, item.rows[row].place).line; };
    const int line = lineOf(0);
    if (auto checked = checkDirection(item.rows, name, lineOf); !checked) return checked;
    sortByTime(item.rows, defects);
    keepLastOfEqualStamps(item.rows, defects);
    const std::string key = "window " + std::to_string(item.number);
    if (item.rows.size() < fewestRows) return fail(name, tooShortCause(item.rows.size()), line, key);
    const Nanoseconds first = item.rows.front().time;
    if (item.rows.back().time - first > longestWindow) return fail(name, "longer than 1000 s", line, key);
    for (Row& row : item.rows) row.time -= first;
    return {};
}

bool isNear(double a, double b) { return std::abs(a - b) <= continuedWheelStep; }
bool isAtRest(const Wheels& wheels) {
    return std::abs(wheels.left) < restingWheel && std::abs(wheels.right) < restingWheel;
}

/// True where the robot was not stopped or moved between the windows.
bool isContinued(const Window& before, const Window& after) {
    if (after.number != before.number + 1) return false;
    if (after.step == before.step) return true;
    const Wheels &last = before.rows.back().wheels, &first = after.rows.front().wheels;
    if (isAtRest(first) && !isAtRest(last)) return false;
    return isNear(last.left, first.left) && isNear(last.right, first.right);
}

/// How long a window lasts: to the instant where the next one begins if it is continued.
Nanoseconds length(const Window& item) {
    const Nanoseconds last = item.rows.back().time;
    return 2 * last - item.rows[item.rows.size() - 2].time;
}

void addRows(Trajectory& trajectory, const Window& item, Nanoseconds from, const DifferentialDrive& drive) {
    for (const Row& row : item.rows) {
        const Nanoseconds stamp = item.start + row.time;
        if (stamp < from) continue;
        const Command measured = drive.toCommand(row.wheels.left, row.wheels.right);
        trajectory.commands.push_back({stamp, drive.toCommand(row.command.left, row.command.right)});
        trajectory.measuredVelocity.push_back({stamp, {measured.v, measured.w}});
        trajectory.measuredRotation.push_back({stamp, {0, row.yawRate}});
    }
}

Trajectory toTrajectory(const std::vector<Window>& windows, std::size_t index, const LogOptions& options,
                        LogDefects& defects) {
    const Window& item = windows[index];
    Trajectory trajectory;
    trajectory.name = std::to_string(item.number);
    trajectory.group = item.step;
    trajectory.steady = item.isSteady;
    const Nanoseconds from = item.start - longestPast;
    std::size_t first = index;
    while (windows[first].continues && windows[first].start > from) --first;
    for (; first <= index; ++first) addRows(trajectory, windows[first], from, options.drive);
    for (const Row& row : item.rows) trajectory.poses.push_back({item.start + row.time, row.pose});
    conditionPoses(trajectory.poses, options, defects);
    return trajectory;
}

/// Where a command was issued a row after its first window began, the file gives that window the step before. It
/// belongs to the step of its command, or a command that is held out would be learned from.
void correctSteps(std::vector<Window>& windows) {
    const auto commandOf = [](const Window& item) { return item.rows[item.rows.size() / 2].command; };
    for (std::size_t i = 0; i + 1 < windows.size(); ++i)
        if (!windows[i].isSteady && windows[i + 1].isSteady && commandOf(windows[i]) == commandOf(windows[i + 1]))
            windows[i].step = windows[i + 1].step;
}

/// Windows one after another on one clock, with a pause where they do not continue each other.
void placeInTime(std::vector<Window>& windows) {
    for (std::size_t i = 1; i < windows.size(); ++i) {
        windows[i].continues = isContinued(windows[i - 1], windows[i]);
        windows[i].start = windows[i - 1].start + length(windows[i - 1]) + (windows[i].continues ? 0 : pause);
    }
}

}  // namespace

Expected<Log> parseHusky(std::string_view content, const std::string& name, const LogOptions& options) {
    bool cutOff = false;
    auto windows = parseWindows(content, name, cutOff);
    if (!windows) return tl::unexpected(windows.error());
    RobotLog robot{"husky", {}, {}};
    std::vector<std::string> incomplete;
    if (cutOff) {
        ++robot.defects.cutLines;
        incomplete.push_back(cutLineText(name));
        // Of the last window next to nothing may be left.
        if (!windows->empty() && windows->back().rows.size() < fewestRows) {
            incomplete.push_back("Window " + std::to_string(windows->back().number) +
                                 " is left out: a single row of it is there.");
            windows->pop_back();
        }
    }
    if (windows->empty()) return fail(name, tooShortCause(0));
    for (Window& item : *windows)
        if (auto arranged = arrange(item, content, name, robot.defects); !arranged)
            return tl::unexpected(arranged.error());
    correctSteps(*windows);
    placeInTime(*windows);
    for (std::size_t i = 0; i < windows->size(); ++i)
        robot.trajectories.push_back(toTrajectory(*windows, i, options, robot.defects));
    return Log{name,  "husky-windows",      0, {std::move(robot)}, {{name, contentHash(content)}},
               false, std::move(incomplete)};
}

Expected<Log> readHusky(const std::filesystem::path& file, const LogOptions& options) {
    const auto content = readFile(file);
    if (!content) return tl::unexpected(content.error());
    return parseHusky(*content, file.string(), options);
}

bool looksLikeHusky(std::string_view content) {
    const std::string name;
    const auto rows = CsvRows::open(content, name);
    return rows && rows->header().size() > 1 && rows->header()[0] == columnNames[0] &&
           rows->header()[1] == columnNames[1];
}

}  // namespace mrose
