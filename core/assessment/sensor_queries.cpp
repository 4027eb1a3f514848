#include "assessment/sensor_queries.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/pose.h"
#include "io/file.h"
#include "learning/parallel_for.h"
#include "logs/csv_rows.h"
#include "world/noise.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr std::string_view queryColumns[] = {"dataset", "robot", "t", "subject"};
constexpr const char* noNumber = "; dataset is 0 where the log has no number";
constexpr CellKind queryKinds[] = {CellKind::number, CellKind::text, CellKind::instant, CellKind::text};

/// A query's place in a log.
struct QueryPlace {
    std::size_t robot = 0, trajectory = 0, subject = 0;
};

/// Of a robot, the trajectory with ground truth round an instant: a gap in it is bridged.
std::optional<std::size_t> trajectoryAt(const RobotLog& robot, Nanoseconds time) {
    for (std::size_t i = 0; i < robot.trajectories.size(); ++i) {
        const std::vector<StampedPose>& poses = robot.trajectories[i].poses;
        if (!poses.empty() && poses.front().time <= time && time <= poses.back().time) return i;
    }
    return std::nullopt;
}

Expected<QueryPlace> placeOf(const SensorQuery& query, const Log& log, const std::string& fileName) {
    if (log.dataset != 0 && query.dataset != log.dataset)
        return fail(
            fileName,
            "is of data set " + std::to_string(query.dataset) + "; the log is number " + std::to_string(log.dataset),
            query.line, "dataset");
    QueryPlace place;
    const auto robot = std::ranges::find(log.robots, query.robot, &RobotLog::robot);
    if (robot == log.robots.end())
        return fail(fileName, "the log " + log.source + " has no robot " + query.robot, query.line, "robot");
    place.robot = static_cast<std::size_t>(robot - log.robots.begin());
    const auto subject = std::ranges::find(log.subjects, query.subject, &LogSubject::name);
    if (subject == log.subjects.end())
        return fail(fileName, "the log " + log.source + " has no subject " + query.subject, query.line, "subject");
    place.subject = static_cast<std::size_t>(subject - log.subjects.begin());
    const auto trajectory = trajectoryAt(*robot, query.time);
    if (!trajectory)
        return fail(fileName, "no ground truth of robot " + query.robot + " at " + secondsText(query.time) + " s",
                    query.line, "t");
    place.trajectory = *trajectory;
    return place;
}

}  // namespace

Expected<std::vector<SensorQuery>> parseQueries(std::string_view content, const std::string& fileName) {
    auto rows = CsvRows::open(content, fileName);
    if (!rows) return tl::unexpected(rows.error());
    const std::vector<std::string_view>& header = rows->header();
    std::vector<CellKind> kinds(header.size(), CellKind::text);
    std::array<std::size_t, std::size(queryColumns)> at{};
    for (std::size_t i = 0; i < at.size(); ++i) {
        at[i] = static_cast<std::size_t>(std::ranges::find(header, queryColumns[i]) - header.begin());
        if (at[i] == header.size())
            return fail(fileName,
                        std::string("the header has no such column; expected dataset,robot,t,subject") +
                            (i == 0 ? noNumber : ""),
                        rows->headerLine(), std::string(queryColumns[i]));
        kinds[at[i]] = queryKinds[i];
    }
    rows->setKinds(std::move(kinds));
    std::vector<SensorQuery> queries;
    while (rows->next()) {
        for (std::size_t i = 0; i < at.size(); ++i)
            if (!rows->cells()[at[i]].present)
                return tl::unexpected(rows->about(std::string(queryColumns[i]),
                                                  std::string("the cell is empty") + (i == 0 ? noNumber : "")));
        const double dataset = rows->cells()[at[0]].number;
        if (dataset != std::floor(dataset) || std::abs(dataset) > 1e9)
            return tl::unexpected(rows->about("dataset", "is no whole number"));
        queries.push_back({static_cast<int>(dataset), std::string(rows->cells()[at[1]].text),
                           std::string(rows->cells()[at[3]].text), rows->cells()[at[2]].instant, rows->line()});
    }
    if (rows->error()) return tl::unexpected(*rows->error());
    return queries;
}

Expected<std::vector<SensorQuery>> readQueries(const std::filesystem::path& file) {
    return readFile(file).and_then([&](const std::string& text) { return parseQueries(text, file.string()); });
}

Expected<std::vector<SensorPrediction>> predictQueries(const LearnedSensor& sensor, const LoggedView& view,
                                                       std::span<const SensorQuery> queries,
                                                       const std::string& fileName) {
    // queries of one look are predicted together
    std::map<std::tuple<std::size_t, std::size_t, Nanoseconds>, std::vector<std::pair<std::size_t, std::size_t>>> looks;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const auto place = placeOf(queries[i], view.log(), fileName);
        if (!place) return tl::unexpected(place.error());
        looks[{place->robot, place->trajectory, queries[i].time}].emplace_back(i, place->subject);
    }
    std::vector<SensorPrediction> predictions(queries.size());
    for (const auto& [look, asked] : looks) {
        const auto& [robot, trajectory, time] = look;
        const std::vector<LoggedSubject> subjects =
            view.at(robot, trajectory, time - sensor.network().latency, sensor.network().view);
        const int index = sensor.robotIndex(view.log().robots[robot].robot);
        for (const auto& [query, subject] : asked) {
            const auto found = std::ranges::find(subjects, subject, &LoggedSubject::subject);
            if (found == subjects.end()) continue;
            SensorPrediction& prediction = predictions[query];
            prediction.state = found->state;
            prediction.inView = sensor.inView(found->state);
            sensor.distributions({&found->state, 1}, index, {&prediction.distribution, 1});
        }
    }
    return predictions;
}

std::string sensorSamplesCsv(std::span<const SensorQuery> queries, std::span<const SensorPrediction> predictions,
                             int samples, std::uint64_t seed) {
    std::vector<std::string> parts(queries.size());
    parallelFor(queries.size(), [&](std::size_t i) {
        const SensorQuery& query = queries[i];
        const SensorPrediction& prediction = predictions[i];
        const double chance = prediction.inView ? prediction.distribution.probability() : 0;
        for (int s = 0; s < samples; ++s) {
            const auto channel = static_cast<std::uint32_t>(2 * s);
            const NoiseKey key{seed, static_cast<std::int64_t>(i), 0, channel};
            const NoisePair normals = normalPair(key);
            const double which = uniformNoise({key.seed, key.tick, 0, channel + 1});
            const ReadingError error = prediction.distribution.error({0, which, {normals.first, normals.second}});
            char row[200];
            std::snprintf(row, sizeof row, "%d,%s,%s,%s,%.5f,%d,%.4f,%.5f\n", query.dataset, query.robot.c_str(),
                          secondsText(query.time).c_str(), query.subject.c_str(), chance, s,
                          std::max(0.0, prediction.state.range + error[0]),
                          wrapAngle(prediction.state.bearing + error[1]));
            parts[i] += row;
        }
    });
    std::string csv = "dataset,robot,t,subject,p_detect,sample,range_m,bearing_rad\n";
    for (const std::string& part : parts) csv += part;
    return csv;
}

}  // namespace mrose
