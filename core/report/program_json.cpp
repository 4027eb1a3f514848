#include "report/program_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "identification/held_out_part.h"
#include "io/format.h"
#include "logs/sensor_defects.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using Printed = nlohmann::json;  // sorted by key

Printed printed(const MeasuredRange& range) {
    return range.empty() ? Printed(nullptr) : Printed{range.least, range.most};
}

Printed printed(const ChannelDelay& c) {
    if (!c.identified) return {{"identified", false}, {"reason", c.reason}};
    return {{"identified", true},
            {"dead_time_s", c.deadTime},
            {"dead_time_error_s", c.deadTimeError},
            {"lag_s", c.lag},
            {"lag_error_s", c.lagError},
            {"jitter_s", c.jitter},
            {"jitter_error_s", c.jitterError},
            {"explained", c.explained},
            {"quality", c.quality()}};
}

Printed printed(const SensorLateness& lateness) {
    if (!lateness.identified) return {{"identified", false}, {"reason", lateness.reason}};
    return {{"identified", true}, {"lateness_s", lateness.lateness}, {"lateness_error_s", lateness.error}};
}

Printed printed(const SensorChange& change) {
    Printed json{{"quantity", change.bearing ? "bearing" : "range"},
                 {"trajectory", change.trajectory},
                 {"begin_s", change.begin},
                 {"end_s", change.end},
                 {change.bearing ? "offset_rad" : "offset_share", change.offset},
                 {change.bearing ? "offset_error_rad" : "offset_error_share", change.error},
                 {"cause", change.cause == SensorChange::Cause::truth    ? "ground truth"
                           : change.cause == SensorChange::Cause::sensor ? "sensor"
                                                                         : "unknown"}};
    if (change.headingError > 0) {
        json["heading_offset_rad"] = change.headingOffset;
        json["heading_offset_error_rad"] = change.headingError;
    }
    return json;
}

Printed printed(const SensorInspection& sensor) {
    Printed defects, changes = Printed::array();
    for (const SensorDefectCount& count : sensorDefectCounts()) defects[count.key] = sensor.defects.*count.count;
    for (const SensorChange& change : sensor.changes) changes.push_back(printed(change));
    Printed json{{"sensor", sensor.sensor},
                 {"looks", sensor.looks},
                 {"looks_with_readings", sensor.seeingLooks},
                 {"readings", sensor.readings},
                 {"subjects", sensor.subjects},
                 {"landmark_readings", sensor.landmarkReadings},
                 {"poses", sensor.poses},
                 {"scans", sensor.scans},
                 {"period_s", sensor.period > 0 ? Printed(sensor.period) : Printed(nullptr)},
                 {"period_spread_s", sensor.period > 0 ? Printed(sensor.periodSpread) : Printed(nullptr)},
                 {"lateness", printed(sensor.lateness)},
                 {"defects", defects},
                 {"changes", changes},
                 {"truth", nullptr}};
    if (sensor.known > 0)
        json["truth"] = {{"readings", sensor.known},
                         {"gross", sensor.gross},
                         {"range_offset_m", sensor.rangeOffset},
                         {"range_spread_m", sensor.rangeSpread},
                         {"bearing_offset_rad", sensor.bearingOffset},
                         {"bearing_spread_rad", sensor.bearingSpread}};
    if (sensor.pose.poses > 0)
        json["truth"] = {{"poses", sensor.pose.poses},
                         {"position_off_m", sensor.pose.distance},
                         {"heading_off_rad", sensor.pose.heading},
                         {"looks_exchanged", sensor.pose.looksExchanged()}};
    return json;
}

Printed printed(const RobotInspection& robot) {
    Printed defects;
    for (const DefectCount& count : defectCounts()) defects[count.key] = robot.defects.*count.count;
    defects["longest_command_gap_s"] = robot.defects.longestCommandGap;
    defects["longest_pose_gap_s"] = robot.defects.longestPoseGap;
    defects["longest_ball_gap_s"] = robot.defects.longestBallGap;
    Printed sensors = Printed::array();
    for (const SensorInspection& sensor : robot.sensors) sensors.push_back(printed(sensor));
    return {{"robot", robot.robot},
            {"trajectories", robot.trajectories},
            {"commands",
             {{"count", robot.commands},
              {"seconds", robot.commandTime},
              {"rate_hz", robot.commandRate()},
              {"v_mps", printed(robot.v)},
              {"w_radps", printed(robot.w)}}},
            {"poses",
             {{"count", robot.poses},
              {"seconds", robot.poseTime},
              {"rate_hz", robot.poseRate()},
              {"x_m", printed(robot.x)},
              {"y_m", printed(robot.y)}}},
            {"ball", {{"count", robot.ball}, {"seconds", robot.ballTime}, {"rate_hz", robot.ballRate()}}},
            {"kicks", {{"count", robot.kicks}, {"power", printed(robot.kickPower)}}},
            {"defects", defects},
            {"sensors", sensors},
            {"delays", {{"v", printed(robot.delays.v)}, {"w", printed(robot.delays.w)}}}};
}

Printed choiceJson(const VariantChoice& choice) {
    Printed json{{"mean", choice.mean}, {"best_variant", choice.variants[choice.best].name}};
    if (choice.oracle)
        json["oracle"] = {{"mean", choice.oracle->mean},
                          {"closed", choice.oracle->closed},
                          {"closed_low", choice.oracle->closedInterval.low},
                          {"closed_high", choice.oracle->closedInterval.high},
                          {"agrees", choice.oracle->agrees}};
    for (const VariantChoice::Variant& variant : choice.variants)
        json["variants"].push_back({{"name", variant.name},
                                    {"mean", variant.mean},
                                    {"share", variant.share},
                                    {"chosen", variant.chosen},
                                    {"gain", variant.gain},
                                    {"gain_low", variant.gainInterval.low},
                                    {"gain_high", variant.gainInterval.high}});
    return json;
}

/// Those that there are.
Printed limitsJson(const ActuatorLimits& limits) {
    Printed json = Printed::object();
    const auto add = [&](const char* key, double limit) {
        if (limit > 0) json[key] = limit;
    };
    add("acceleration_v_mps2", limits.accelerationV);
    add("acceleration_w_radps2", limits.accelerationW);
    add("wheel_speed_mps", limits.wheelSpeed);
    add("half_track_m", limits.halfTrack);
    return json;
}

}  // namespace

std::string inspectionJson(const LogInspection& inspection) {
    Printed json{{"source", inspection.source},
                 {"format", inspection.format},
                 {"synthetic", inspection.synthetic},
                 {"incomplete", inspection.incomplete},
                 {"unit_doubts", inspection.unitDoubts}};
    for (const LogFile& file : inspection.files) json["files"].push_back({{"path", file.path}, {"xxh3", file.hash}});
    for (const LogFile& file : inspection.measurementFiles)
        json["measurement_files"].push_back({{"path", file.path}, {"xxh3", file.hash}});
    for (const RobotInspection& robot : inspection.robots) json["robots"].push_back(printed(robot));
    return json.dump(2);
}

std::string trainingJson(const TrainedNetwork& trained, const std::string& file, double seconds) {
    const MotionNetwork& n = trained.network;
    return Printed{{"network", file},
                   {"patterns", n.training.patterns},
                   {"epochs", n.training.epochs},
                   {"seconds", seconds},
                   {"held_out_windows", n.heldOut.windows},
                   {"held_out_position_percent", n.heldOut.position},
                   {"held_out_heading_percent", n.heldOut.heading},
                   {"kept_from_learning", keptFromLearning(n.heldOut.part)},
                   {"limits", limitsJson(n.limits)},
                   {"noise", n.noise.has_value()},
                   {"noise_of_known_robots", trained.noiseOfKnownRobots},
                   {"without_noise", trained.withoutNoise},
                   {"interrupted", trained.cancelled}}
        .dump(2);
}

std::string sensorTrainingJson(const SensorNetwork& network, const std::vector<std::string>& notices,
                               const std::string& file, double seconds) {
    const bool ofPose = network.measures == SensorNetwork::Measures::pose;
    return Printed{{"network", file},
                   {"sensor", network.sensor},
                   {"measures", ofPose ? "pose" : "subjects"},
                   {"family", nameOf(familyOf(network.learned.regressor))},
                   {"seconds", seconds},
                   {"looks", network.heldOut.looks},
                   {ofPose ? "poses" : "readings", network.heldOut.readings},
                   {"latency_s", toSeconds(network.latency)},
                   {"held_out_detection_log_likelihood", network.heldOut.reported},
                   {"held_out_error_log_likelihood", network.heldOut.error},
                   {"notices", notices}}
        .dump(2);
}

std::string runJson(const Scenario& scenario, const RunResult& result, const RunNames& names) {
    const RunStatistics& statistics = result.statistics;
    Printed json{{"touches", statistics.touches},
                 {"kicks", statistics.kicks},
                 {"hits", statistics.hits},
                 {"faults", statistics.faults},
                 {"ball_still_s", static_cast<double>(statistics.ballStill) / nanosecondsPerSecond},
                 {"first_fault", statistics.firstFault}};
    for (std::size_t g = 0; g < statistics.goals.size(); ++g)
        json["goals"][scenario.scene().environment.goals[g].name] = statistics.goals[g];
    for (std::size_t i = 0; i < statistics.driven.size(); ++i)
        json["driven_m"][scenario.scene().robots[i].name] = statistics.driven[i];
    for (std::size_t i = 0; i < statistics.unfamiliar.size(); ++i)
        if (const auto& ticks = statistics.unfamiliar[i])
            json["unfamiliar"][scenario.scene().robots[i].name] = statistics.shareOf(*ticks);
    for (std::size_t i = 0; i < statistics.beyond.size(); ++i)
        if (const auto& ticks = statistics.beyond[i])
            json["beyond_learned"][scenario.scene().robots[i].name] = statistics.shareOf(*ticks);
    json["scenario"] = scenario.parts().name;
    json["trial"] = names.trial;
    if (!names.variant.empty()) json["variant"] = names.variant;
    json["seed"] = result.state.seed;
    json["end"] = name(result.end);
    // divided, as in the rows of a batch: toSeconds() multiplies, and 60 s would be 60.00000000000001
    json["time_s"] = static_cast<double>(result.state.tick * scenario.scene().tickLength) / nanosecondsPerSecond;
    json["world_hash"] = hexadecimal(hashOf(result.state).world);
    if (names.rewindChecked && result.end != RunEnd::rewind) json["ticks_taken_twice"] = statistics.ticks;
    if (!names.recording.empty()) json["recording"] = names.recording;
    for (const auto& [name, value] : names.measured) json[name] = value;
    return json.dump(2);
}

std::string batchJson(const BatchSummary& summary, const std::string& folder) {
    Printed json{{"runs", summary.runs},
                 {"done", summary.results.rows},
                 {"resumed", summary.resumed},
                 {"ended_by_condition", summary.results.ended},
                 {"faulty", summary.results.faulty},
                 {"complete", summary.complete}};
    if (summary.complete) json["results"] = folder + "/results.csv";
    return json.dump(2);
}

std::string experimentJson(const ExperimentSummary& summary, const std::string& folder) {
    Printed json{
        {"runs", summary.runs}, {"done", summary.done}, {"resumed", summary.resumed}, {"complete", summary.complete}};
    for (const VariantSummary& variant : summary.variants) {
        Printed one{{"variant", variant.name},
                    {"runs", variant.runs},
                    {"ended_by_condition", variant.ended},
                    {"ended_by_fault", variant.faulty}};
        if (variant.faulty > 0) one["first_fault"] = variant.firstFault;
        if (variant.sweep)
            one["sweep"] = {{"name", variant.sweep->name}, {"unit", variant.sweep->unit}, {"value", variant.sweep->at}};
        for (const MeasureSummary& measure : variant.measures) {
            const auto number = [&](double value) { return measure.count > 0 ? Printed(value) : Printed(nullptr); };
            one["measures"][measure.name] = {{"count", measure.count},
                                             {"mean", number(measure.mean)},
                                             {"deviation", number(measure.deviation)},
                                             {"least", number(measure.least)},
                                             {"most", number(measure.most)}};
            const Estimate& of = measure.estimate;
            if (std::isfinite(of.low)) one["measures"][measure.name]["interval_95"] = {of.low, of.high};
        }
        json["variants"].push_back(std::move(one));
    }
    if (summary.complete) json["results"] = folder + "/results.csv";
    return json.dump(2);
}

std::string validationJson(const Validation& validation, const ValidationResult& result, const std::string& folder) {
    const auto number = [](double value) { return std::isfinite(value) ? Printed(value) : Printed(nullptr); };
    const auto estimate = [&](const Estimate& of) {
        return Printed{{"value", number(of.value)}, {"low", number(of.low)}, {"high", number(of.high)}};
    };
    Printed json{{"validation", validation.name}, {"synthetic_reality", !validation.real.has_value()}};
    for (const CellRuns& cell : result.cells)
        json["cells"].push_back({{"name", cell.name},
                                 {"measured", cell.measured},
                                 {"runs", cell.runs},
                                 {"unfinished", cell.unfinished},
                                 {"ended_by_fault", cell.faulty},
                                 {"simulated_h", cell.hours}});
    for (const MeasureValidation& of : result.measures) {
        Printed one{{"name", of.measure.name},
                    {"better", of.measure.lessIsBetter ? "less" : "more"},
                    {"yes_no", of.measure.yesNo},
                    {"trials", of.trials.size()},
                    {"left_out", of.leftOut}};
        for (const Estimate& cell : of.cells) one["cells"].push_back(estimate(cell));
        one["gain_in_simulation"] = estimate(of.gain[0]);
        one["gain_in_reality"] = estimate(of.gain[1]);
        one["survives"] = estimate(of.survives);
        one["worse_in_reality_before"] = estimate(of.worse[0]);
        one["worse_in_reality_after"] = estimate(of.worse[1]);
        json["measures"].push_back(std::move(one));
    }
    const AccountResult& account = result.account;
    json["account"] = {{"log_min", account.logMinutes ? Printed(*account.logMinutes) : Printed(nullptr)},
                       {"simulated_h", account.simulatedHours},
                       {"spared_h", account.sparedHours()}};
    json["page"] = folder + "/report.html";
    json["results"] = folder + "/results.csv";
    return json.dump(2);
}

std::string learnedTaskJson(const TaskData& data, const TaskJudgement& judgement, const std::string& file) {
    Printed json{{"network", file},
                 {"target", data.target},
                 {"inputs", data.inputs},
                 {"rows", data.rows()},
                 {"held_out", judgement.heldOut.rows()},
                 {"left_out", {{"unfinished", data.unfinished}, {"faulty", data.faulty}, {"unknown", data.unknown}}}};
    for (const TaskJudgement::Predictor& predictor : judgement.predictors) {
        const TaskScore& score = predictor.score;
        Printed one{{"name", predictor.name},
                    {"values", score.values},
                    {"share", score.share},
                    {"share_low", score.shareInterval.low},
                    {"share_high", score.shareInterval.high},
                    {"mean_absolute", score.absolute},
                    {"root_mean_square", score.rootMeanSquare},
                    {"bias", score.bias}};
        if (predictor.choice) one["choice"] = choiceJson(*predictor.choice);
        json["scores"].push_back(std::move(one));
    }
    return json.dump(2);
}

std::string replayJson(const Recording& recording, const ReplayReport& report) {
    const auto& difference = report.difference;
    Printed json{{"ticks", report.ticks},
                 {"branches", recording.branches.size()},
                 {"same", !difference && !report.cancelled},
                 {"damage", recording.damage}};
    if (difference)
        json["difference"] = {{"branch", difference->branch}, {"tick", difference->tick}, {"what", difference->what}};
    return json.dump(2);
}

}  // namespace mrose
