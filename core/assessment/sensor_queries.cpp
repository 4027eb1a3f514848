#include "assessment/sensor_queries.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/pose.h"
#include "io/file.h"
#include "learning/parallel_for.h"
#include "logs/csv_rows.h"
#include "logs/pose_grid.h"
#include "world/noise.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr std::string_view queryColumns[] = {"robot", "t", "dataset", "subject"};  // own poses are asked by the first
constexpr std::size_t poseColumns = 2, subjectColumns = 4;
constexpr const char* noNumber = "; dataset is 0 where the log has no number";
constexpr CellKind queryKinds[] = {CellKind::text, CellKind::instant, CellKind::number, CellKind::text};

/// A query's place in a log.
struct QueryPlace {
    std::size_t robot = 0, trajectory = 0, subject = 0;  ///< subject: 0 of an own pose
};

/// Of a robot, the trajectory with ground truth round an instant: a gap in it is bridged.
std::optional<std::size_t> trajectoryAt(const RobotLog& robot, Nanoseconds time) {
    for (std::size_t i = 0; i < robot.trajectories.size(); ++i) {
        const std::vector<StampedPose>& poses = robot.trajectories[i].poses;
        if (!poses.empty() && poses.front().time <= time && time <= poses.back().time) return i;
    }
    return std::nullopt;
}

/// A pose is judged by the truth at the instant that it is of, so that there must be truth then; a look by that at its
/// stamp.
Expected<QueryPlace> placeOf(const SensorQuery& query, const SensorNetwork& sensor, const Log& log,
                             const std::string& fileName) {
    const bool ofSubject = sensor.measures == SensorMeasures::subjects;
    if (ofSubject && log.dataset != 0 && query.dataset != log.dataset)
        return fail(
            fileName,
            "is of data set " + std::to_string(query.dataset) + "; the log is number " + std::to_string(log.dataset),
            query.line, "dataset");
    QueryPlace place;
    const auto robot = std::ranges::find(log.robots, query.robot, &RobotLog::robot);
    if (robot == log.robots.end())
        return fail(fileName, "the log " + log.source + " has no robot " + query.robot, query.line, "robot");
    place.robot = static_cast<std::size_t>(robot - log.robots.begin());
    if (ofSubject) {
        const auto subject = std::ranges::find(log.subjects, query.subject, &LogSubject::name);
        if (subject == log.subjects.end())
            return fail(fileName, log.withIncomplete("the log " + log.source + " has no subject " + query.subject),
                        query.line, "subject");
        place.subject = static_cast<std::size_t>(subject - log.subjects.begin());
    }
    const Nanoseconds before = ofSubject ? 0 : sensor.latency;
    const auto trajectory = trajectoryAt(*robot, query.time - before);
    if (!trajectory)
        return fail(fileName,
                    "no ground truth of robot " + query.robot + " at " + secondsText(query.time - before) + " s" +
                        (before > 0 ? ", which a pose of this stamp is of" : ""),
                    query.line, "t");
    place.trajectory = *trajectory;
    return place;
}

SensorPrediction predictPose(const LearnedSensor& sensor, const LoggedView& view, const QueryPlace& at,
                             Nanoseconds measured) {
    SensorPrediction prediction{.inView = true};
    const RobotLog& robot = view.log().robots[at.robot];
    prediction.state.own = truthAt(robot.trajectories[at.trajectory].poses, measured);
    prediction.state.velocity = view.velocityOf(at.robot, at.trajectory, measured);
    sensor.distributions({&prediction.state, 1}, sensor.robotIndex(robot.robot), {&prediction.distribution, 1});
    return prediction;
}

/// One draw of a reading's error.
ReadingError drawnError(const ReadingDistribution& distribution, std::uint64_t seed, std::size_t query, int sample) {
    const auto channel = static_cast<std::uint32_t>(2 * sample);
    const auto key = [&](std::uint32_t entity, std::uint32_t number) {
        return NoiseKey{seed, static_cast<std::int64_t>(query), entity, number};
    };
    const NoisePair normals = normalPair(key(0, channel));
    const double third = distribution.form.dimensions > 2 ? normalPair(key(1, channel)).first : 0;
    return distribution.error({0, uniformNoise(key(0, channel + 1)), {normals.first, normals.second, third}});
}

}  // namespace

Expected<std::vector<SensorQuery>> parseQueries(std::string_view content, const std::string& fileName,
                                                SensorMeasures measures) {
    auto rows = CsvRows::open(content, fileName);
    if (!rows) return tl::unexpected(rows.error());
    const std::vector<std::string_view>& header = rows->header();
    std::vector<CellKind> kinds(header.size(), CellKind::text);
    const bool ofSubjects = measures == SensorMeasures::subjects;
    const std::size_t columns = ofSubjects ? subjectColumns : poseColumns;
    const auto about = [](std::size_t column) { return queryColumns[column] == "dataset" ? noNumber : ""; };
    std::array<std::size_t, std::size(queryColumns)> at{};
    for (std::size_t i = 0; i < columns; ++i) {
        at[i] = static_cast<std::size_t>(std::ranges::find(header, queryColumns[i]) - header.begin());
        if (at[i] == header.size())
            return fail(fileName,
                        std::string("the header has no such column; expected ") +
                            (ofSubjects ? "dataset,robot,t,subject" : "robot,t") + about(i),
                        rows->headerLine(), std::string(queryColumns[i]));
        kinds[at[i]] = queryKinds[i];
    }
    rows->setKinds(std::move(kinds));
    std::vector<SensorQuery> queries;
    while (rows->next()) {
        const auto cell = [&](std::size_t column) -> const auto& { return rows->cells()[at[column]]; };
        for (std::size_t i = 0; i < columns; ++i)
            if (!cell(i).present)
                return tl::unexpected(
                    rows->about(std::string(queryColumns[i]), std::string("the cell is empty") + about(i)));
        SensorQuery query{.robot = std::string(cell(0).text), .time = cell(1).instant, .line = rows->line()};
        if (ofSubjects) {
            const double dataset = cell(2).number;
            if (dataset != std::floor(dataset) || std::abs(dataset) > 1e9)
                return tl::unexpected(rows->about("dataset", "is no whole number"));
            query.dataset = static_cast<int>(dataset);
            query.subject = cell(3).text;
        }
        queries.push_back(std::move(query));
    }
    if (rows->error()) return tl::unexpected(*rows->error());
    return queries;
}

Expected<std::vector<SensorQuery>> readQueries(const std::filesystem::path& file, SensorMeasures measures) {
    return readFile(file).and_then(
        [&](const std::string& text) { return parseQueries(text, file.string(), measures); });
}

Expected<std::vector<SensorPrediction>> predictQueries(const LearnedSensor& sensor, const LoggedView& view,
                                                       std::span<const SensorQuery> queries,
                                                       const std::string& fileName) {
    const SensorMeasures measures = sensor.network().measures;
    std::vector<SensorPrediction> predictions(queries.size());
    // queries of one look are predicted together
    std::map<std::tuple<std::size_t, std::size_t, Nanoseconds>, std::vector<std::pair<std::size_t, std::size_t>>> looks;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const auto place = placeOf(queries[i], sensor.network(), view.log(), fileName);
        if (!place) return tl::unexpected(place.error());
        if (measures == SensorMeasures::pose) {
            predictions[i] = predictPose(sensor, view, *place, queries[i].time - sensor.network().latency);
            continue;
        }
        looks[{place->robot, place->trajectory, queries[i].time}].emplace_back(i, place->subject);
    }
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

std::string sensorSamplesCsv(SensorMeasures measures, std::span<const SensorQuery> queries,
                             std::span<const SensorPrediction> predictions, int samples, std::uint64_t seed) {
    const bool ofSubjects = measures == SensorMeasures::subjects;
    std::vector<std::string> parts(queries.size());
    parallelFor(queries.size(), [&](std::size_t i) {
        const SensorQuery& query = queries[i];
        const SensorPrediction& prediction = predictions[i];
        const double chance = prediction.inView ? prediction.distribution.probability() : 0;
        const std::string time = secondsText(query.time);
        for (int s = 0; s < samples; ++s) {
            const ReadingError error = drawnError(prediction.distribution, seed, i, s);
            char row[200];
            if (ofSubjects) {
                std::snprintf(row, sizeof row, "%d,%s,%s,%s,%.5f,%d,%.4f,%.5f\n", query.dataset, query.robot.c_str(),
                              time.c_str(), query.subject.c_str(), chance, s,
                              std::max(0.0, prediction.state.range + error[0]),
                              wrapAngle(prediction.state.bearing + error[1]));
            } else {
                const Pose reported = prediction.state.own * Pose{error[0], error[1], error[2]};
                std::snprintf(row, sizeof row, "%s,%s,%.5f,%d,%.4f,%.4f,%.5f\n", query.robot.c_str(), time.c_str(),
                              chance, s, reported.x, reported.y, reported.heading);
            }
            parts[i] += row;
        }
    });
    std::string csv = ofSubjects ? "dataset,robot,t,subject,p_detect,sample,range_m,bearing_rad\n"
                                 : "robot,t,p_report,sample,x,y,heading\n";
    for (const std::string& part : parts) csv += part;
    return csv;
}

}  // namespace mrose
