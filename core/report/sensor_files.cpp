#include "report/sensor_files.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "io/format.h"
#include "world/seconds_text.h"

namespace mrose {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* dimensionKeys[readingDimensions] = {"range", "bearing"};
constexpr const char* unitKeys[readingDimensions] = {"m", "rad"};

std::string cell(double value, int decimals) { return std::isfinite(value) ? fixed(value, decimals) : ""; }

void addRow(std::string& text, const std::string& model, const std::string& robot, const SensorScores& scores) {
    text += cat(csvCell(model), ",", csvCell(robot), ",", std::to_string(scores.cases), ",",
                std::to_string(scores.readings), ",", std::to_string(scores.sound));
    for (const ErrorScores& error : scores.error)
        for (const double value : {error.crps, error.rmse, error.inside50, error.inside90})
            text += cat(",", cell(value, 6));
    for (const double value : {scores.logDensity, scores.detection, scores.off}) text += cat(",", cell(value, 6));
    text += "\n";
}

Json json(const SensorScores& scores) {
    Json all{{"cases", scores.cases}, {"readings", scores.readings}, {"sound_readings", scores.sound}};
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        const ErrorScores& error = scores.error[d];
        const std::string unit = unitKeys[d];
        all[dimensionKeys[d]] = {{"crps_" + unit, error.crps},
                                 {"median_rmse_" + unit, error.rmse},
                                 {"inside_50_percent", error.inside50},
                                 {"inside_90_percent", error.inside90}};
    }
    all["log_density_per_m_rad"] = scores.logDensity;
    all["detection_log_likelihood"] = scores.detection;
    all["calibration_off"] = scores.off;
    Json groups = Json::array();
    for (const CalibrationGroup& group : scores.groups)
        groups.push_back({{"cases", group.cases}, {"predicted", group.predicted}, {"reported", group.reported}});
    all["calibration"] = std::move(groups);
    return all;
}

Json json(const LoggedCases& log, const SensorAssessment& model) {
    Json robots = Json::array();
    for (std::size_t i = 0; i < log.robots.size(); ++i)
        robots.push_back({{"robot", log.robots[i].name}, {"scores", json(model.byRobot[i])}});
    Json below = Json::object();
    for (std::size_t d = 0; d < readingDimensions; ++d) below[dimensionKeys[d]] = model.below[d];
    return {{"name", model.name},
            {"all", json(model.all)},
            {"robots", std::move(robots)},
            {"readings_by_probability_below", std::move(below)}};
}

Json bandsJson(const SensorEvaluation& evaluation) {
    Json all = Json::object();
    for (std::size_t d = 0; d < readingDimensions; ++d)
        for (const BandAxis axis : {BandAxis::range, BandAxis::bearing}) {
            const auto a = static_cast<std::size_t>(axis);
            Json bands = Json::array();
            for (const ErrorBand& band : evaluation.bands[d][a])
                bands.push_back({{std::string("from_") + unitKeys[a], band.from},
                                 {std::string("to_") + unitKeys[a], band.to},
                                 {"readings", band.readings},
                                 {std::string("real_") + unitKeys[d], band.real},
                                 {std::string("predicted_") + unitKeys[d], band.predicted}});
            all[cat(dimensionKeys[d], "_error_by_", dimensionKeys[a])] = std::move(bands);
        }
    return {{"quantiles", bandShares}, {"bands", std::move(all)}};
}

Json linksJson(const SensorEvaluation& evaluation) {
    Json links = Json::object(), robots = Json::array();
    const auto json = [](const ErrorLink& link) {
        return Json{{"pairs", link.pairs}, {"real", link.real}, {"model", link.model}};
    };
    const auto both = [&](const ErrorLinks& of) {
        return Json{{"same_subject_next_look", json(of.next)}, {"another_subject_same_look", json(of.beside)}};
    };
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        links[dimensionKeys[d]] = both(evaluation.links[d]);
        Json& byRobot = links[dimensionKeys[d]]["robots"] = Json::array();
        for (std::size_t i = 0; i < evaluation.linksByRobot.size(); ++i) {
            Json one{{"robot", evaluation.log.robots[i].name}};
            one.update(both(evaluation.linksByRobot[i][d]));
            byRobot.push_back(std::move(one));
        }
    }
    for (std::size_t i = 0; i < evaluation.means.size(); ++i) {
        Json robot{{"robot", evaluation.log.robots[i].name}};
        for (std::size_t d = 0; d < readingDimensions; ++d) {
            const std::string unit = unitKeys[d];
            robot[dimensionKeys[d]] = {{"real_mean_" + unit, evaluation.means[i].real[d]},
                                       {"predicted_mean_" + unit, evaluation.means[i].predicted[d]}};
        }
        robots.push_back(std::move(robot));
    }
    return {{"correlations", std::move(links)}, {"means", std::move(robots)}};
}

Json mapJson(const DetectionMap& map) {
    Json cells = Json::array();
    for (int b = 0; b < map.bearings; ++b)
        for (int r = 0; r < map.ranges; ++r)
            if (const DetectionMap::Cell& cell = map.at(b, r); cell.cases > 0)
                cells.push_back({{"range_from_m", r * map.rangeStep},
                                 {"bearing_from_rad", map.firstBearing + b * map.bearingStep},
                                 {"cases", cell.cases},
                                 {"reported", cell.real},
                                 {"predicted", cell.predicted}});
    return {{"range_step_m", map.rangeStep}, {"bearing_step_rad", map.bearingStep}, {"cells", std::move(cells)}};
}

Json filesJson(const std::vector<LogFile>& files) {
    Json list = Json::array();
    for (const LogFile& file : files) list.push_back({{"path", file.path}, {"xxh3", file.hash}});
    return list;
}

Json logJson(const LoggedCases& log) {
    Json robots = Json::array();
    for (const LoggedCases::Robot& robot : log.robots)
        robots.push_back({{"name", robot.name},
                          {"looks", robot.looks},
                          {"cases", robot.cases},
                          {"readings", robot.readings},
                          {"gross_errors", robot.gross},
                          {"looks_without_truth", robot.withoutTruth}});
    return {{"source", log.source},       {"format", log.format},          {"dataset", log.dataset},
            {"synthetic", log.synthetic}, {"files", filesJson(log.files)}, {"robots", std::move(robots)}};
}

}  // namespace

std::string sensorResultsCsv(const SensorEvaluation& evaluation) {
    std::string text =
        "model,robot,cases,readings,sound_readings,range_crps_m,range_rmse_m,range_inside_50,range_inside_90,"
        "bearing_crps_rad,bearing_rmse_rad,bearing_inside_50,bearing_inside_90,log_density,detection_log_likelihood,"
        "calibration_off\n";
    for (const SensorAssessment& model : evaluation.models) {
        addRow(text, model.name, "all", model.all);
        for (std::size_t i = 0; i < model.byRobot.size(); ++i)
            addRow(text, model.name, evaluation.log.robots[i].name, model.byRobot[i]);
    }
    return text;
}

std::string sensorCasesCsv(const SensorEvaluation& evaluation) {
    const LoggedCases& log = evaluation.log;
    std::string text =
        "dataset,robot,t,subject,range_m,bearing_rad,reported,measured_range_m,measured_bearing_rad,p_detect,"
        "range_error_median_m,bearing_error_median_rad,range_crps_m,bearing_crps_rad\n";
    for (const LoggedLook& look : log.looks)
        for (std::size_t i = look.first; i < look.first + look.count; ++i) {
            const LoggedCase& one = log.cases[i];
            const CaseScore& score = evaluation.models.front().scores[i];
            text += cat(std::to_string(log.dataset), ",", csvCell(log.robots[look.robot].name), ",",
                        secondsText(look.time), ",", csvCell(log.subjects[one.subject]), ",", fixed(one.range, 4), ",",
                        fixed(one.bearing, 5), one.reported ? ",1," : ",0,");
            text += one.reported ? cat(fixed(one.measuredRange, 4), ",", fixed(one.measuredBearing, 5)) : ",";
            text += cat(",", fixed(score.probability, 5));
            if (one.sound)
                text += cat(",", fixed(score.median[0], 4), ",", fixed(score.median[1], 5), ",",
                            fixed(score.crps[0], 5), ",", fixed(score.crps[1], 6), "\n");
            else
                text += ",,,,\n";
        }
    return text;
}

std::string sensorResultsJson(const SensorEvaluation& evaluation, const ReportContext& context) {
    Json facts = Json::object(), models = Json::array();
    for (const auto& [key, value] : context.modelFacts) facts[key] = value;
    for (const SensorAssessment& model : evaluation.models) models.push_back(json(evaluation.log, model));
    const CaseRule& rule = evaluation.log.rule;
    const Json all{{"program", context.program},
                   {"command_line", context.commandLine},
                   {"notices", context.notices},
                   {"sensor", evaluation.log.sensor},
                   {"log", logJson(evaluation.log)},
                   {"model_facts", std::move(facts)},
                   {"training_logs", filesJson(context.trainingLogs)},
                   {"cases_rule",
                    {{"subjects", rule.subjects == SubjectKind::landmark ? "landmarks" : "robots"},
                     {"range_m", rule.range},
                     {"bearing_rad", rule.bearing},
                     {"gross_range_m", rule.grossRange},
                     {"gross_bearing_rad", rule.grossBearing}}},
                   {"models", std::move(models)},
                   {"errors", bandsJson(evaluation)},
                   {"errors_in_common", linksJson(evaluation)},
                   {"detection", mapJson(evaluation.map)}};
    return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mrose
