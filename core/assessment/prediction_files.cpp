#include "assessment/prediction_files.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "assessment/tracker_history.h"
#include "io/file.h"
#include "io/format.h"
#include "logs/csv_rows.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// Where the columns of interest stand; size() of the header: absent.
struct Columns {
    std::size_t dataset, robot, start, trajectory;
};

Expected<Columns> findColumns(const CsvRows& rows, const std::string& fileName) {
    const auto& header = rows.header();
    const auto indexOf = [&](std::string_view column) {
        return static_cast<std::size_t>(std::find(header.begin(), header.end(), column) - header.begin());
    };
    for (const std::string column : {"dataset", "robot", "t_start"})
        if (indexOf(column) == header.size())
            return fail(fileName, "the header has no such column; expected dataset,robot,t_start", rows.headerLine(),
                        column);
    return Columns{indexOf("dataset"), indexOf("robot"), indexOf("t_start"), indexOf("trajectory")};
}

Expected<WindowRequest> toRequest(const CsvRows& rows, const Columns& columns) {
    const auto cells = rows.cells();
    const auto column = [&](std::size_t i) { return std::string(rows.header()[i]); };
    for (const std::size_t i : {columns.dataset, columns.robot, columns.start})
        if (!cells[i].present) return tl::unexpected(rows.about(column(i), "the cell is empty"));
    WindowRequest request;
    const double dataset = cells[columns.dataset].number;
    if (dataset != std::floor(dataset) || std::abs(dataset) > 1e9)
        return tl::unexpected(rows.about("dataset", "is no whole number"));
    request.dataset = static_cast<int>(dataset);
    request.robot = std::string(cells[columns.robot].text);
    request.start = cells[columns.start].instant;
    if (columns.trajectory < cells.size()) request.trajectory = std::string(cells[columns.trajectory].text);
    request.line = rows.line();
    return request;
}

bool severalTrajectories(const Log& log) {
    return std::any_of(log.robots.begin(), log.robots.end(),
                       [](const RobotLog& robot) { return robot.trajectories.size() > 1; });
}

Expected<std::size_t> robotIndex(const Log& log, const WindowRequest& request, const std::string& fileName) {
    for (std::size_t i = 0; i < log.robots.size(); ++i)
        if (log.robots[i].robot == request.robot) return i;
    return fail(fileName, "the log " + log.source + " has no robot " + request.robot, request.line, "robot");
}

Expected<RolloutStart> startOf(const RobotLog& robot, const WindowRequest& request, int steps,
                               const std::string& fileName) {
    std::vector<RolloutStart> candidates;
    for (const Trajectory& trajectory : robot.trajectories) {
        if (!request.trajectory.empty() && trajectory.name != request.trajectory) continue;
        if (const auto start = measureStart(trajectory, request.start, steps)) candidates.push_back(*start);
    }
    if (!request.trajectory.empty() &&
        std::ranges::none_of(robot.trajectories, [&](const Trajectory& t) { return t.name == request.trajectory; }))
        return fail(fileName, "robot " + request.robot + " has no trajectory " + request.trajectory, request.line,
                    "trajectory");
    const std::string when = "robot " + request.robot + " at " + secondsText(request.start) + " s";
    if (candidates.empty())
        return fail(fileName, "no ground truth of " + when + " to start from", request.line, "t_start");
    if (candidates.size() > 1)
        return fail(fileName, "several trajectories have " + when + "; expected a column trajectory", request.line,
                    "t_start");
    return candidates.front();
}

}  // namespace

Expected<std::vector<WindowRequest>> parseWindows(std::string_view content, const std::string& fileName) {
    auto rows = CsvRows::open(content, fileName);
    if (!rows) return tl::unexpected(rows.error());
    const auto columns = findColumns(*rows, fileName);
    if (!columns) return tl::unexpected(columns.error());
    std::vector<CellKind> kinds(rows->header().size(), CellKind::number);
    kinds[columns->robot] = CellKind::text;
    kinds[columns->start] = CellKind::instant;
    if (columns->trajectory < kinds.size()) kinds[columns->trajectory] = CellKind::text;
    rows->setKinds(std::move(kinds));

    std::vector<WindowRequest> requests;
    std::map<std::tuple<int, std::string, std::string, Nanoseconds>, int> lines;
    while (rows->next()) {
        auto request = toRequest(*rows, *columns);
        if (!request) return tl::unexpected(request.error());
        const auto [known, isNew] =
            lines.try_emplace({request->dataset, request->robot, request->trajectory, request->start}, request->line);
        if (!isNew)
            return tl::unexpected(
                rows->about("t_start", "the window of line " + std::to_string(known->second) + " once more"));
        requests.push_back(std::move(*request));
    }
    if (rows->error()) return tl::unexpected(*rows->error());
    if (requests.empty()) return fail(fileName, "has no window", rows->headerLine());
    return requests;
}

Expected<std::vector<WindowRequest>> readWindows(const std::filesystem::path& file) {
    const auto content = readFile(file);
    if (!content) return tl::unexpected(content.error());
    return parseWindows(*content, file.string());
}

std::string windowKey(int dataset, const std::string& robot, Nanoseconds start) {
    return std::to_string(dataset) + "," + robot + "," + secondsText(start);
}

std::string windowsCsv(const LogWindows& log) {
    std::string text = "dataset,robot,t_start,path_m,rotation_rad,trajectory\n";
    for (std::size_t i = 0; i < log.windows.size(); ++i) {
        const Window& w = log.windows[i];
        text += windowKey(log.dataset, log.robots[w.robot].name, w.start) + "," + fixed(w.path, 4) + "," +
                fixed(w.rotation, 4) + "," + log.trajectories[i] + "\n";
    }
    return text;
}

Expected<RequestedStarts> requestedStarts(const Log& log, std::span<const WindowRequest> requests, int steps,
                                          const std::string& fileName) {
    RequestedStarts requested;
    for (const WindowRequest& request : requests) {
        if (request.dataset != log.dataset)
            return fail(fileName,
                        "is " + std::to_string(request.dataset) + ", but the log " + log.source + " is data set " +
                            std::to_string(log.dataset),
                        request.line, "dataset");
        const auto robot = robotIndex(log, request, fileName);
        if (!robot) return tl::unexpected(robot.error());
        const auto start = startOf(log.robots[*robot], request, steps, fileName);
        if (!start) return tl::unexpected(start.error());
        requested.starts.push_back(*start);
        requested.robots.push_back(*robot);
    }
    return requested;
}

PredictionsCsv::PredictionsCsv(const Log& log, const RequestedStarts& requested, Nanoseconds step, bool sampled,
                               std::vector<std::size_t> at)
    : log_(log),
      requested_(requested),
      step_(step),
      sampled_(sampled),
      named_(severalTrajectories(log)),
      at_(std::move(at)),
      rows_(requested.starts.size()) {}

void PredictionsCsv::add(std::span<const std::vector<Pose>> predicted, int sample) {
    for (std::size_t i = 0; i < predicted.size(); ++i) {
        const RolloutStart& start = requested_.starts[i];
        const std::string& robot = log_.robots[requested_.robots[i]].robot;
        std::string key = windowKey(log_.dataset, robot, start.time) + ",";
        if (sampled_) key += std::to_string(sample) + "," + std::to_string(start.seed.value_or(0)) + ",";
        const std::string end = named_ ? "," + start.trajectory->name + "\n" : "\n";
        for (std::size_t k = 1; k <= predicted[i].size(); ++k) {
            if (!at_.empty() && std::find(at_.begin(), at_.end(), k) == at_.end()) continue;
            const Pose& pose = predicted[i][k - 1];
            rows_[i] += key + secondsText(static_cast<Nanoseconds>(k) * step_) + "," + fixed(pose.x, 7) + "," +
                        fixed(pose.y, 7) + "," + fixed(pose.heading, 7) + end;
        }
    }
}

std::string PredictionsCsv::text() const {
    std::string text =
        sampled_ ? "dataset,robot,t_start,sample,seed,t,x,y,heading" : "dataset,robot,t_start,t,x,y,heading";
    text += named_ ? ",trajectory\n" : "\n";
    for (const std::string& rows : rows_) text += rows;
    return text;
}

}  // namespace mrose
