#include "report/evaluation_files.h"

#include "io/format.h"
#include "report/results_json.h"
#include "world/seconds_text.h"

namespace mrose {

using Json = nlohmann::ordered_json;

Json json(const Distribution& d) {
    return {{"count", d.count}, {"mean", d.mean},     {"rms", d.rms}, {"p10", d.p10},
            {"p25", d.p25},     {"median", d.median}, {"p75", d.p75}, {"p90", d.p90}};
}

Json json(const Summary& s) {
    return {{"windows", s.windows},
            {"path_m", s.path},
            {"rotation_rad", s.rotation},
            {"P_percent", s.p},
            {"P_interval95_percent", {s.p95.low, s.p95.high}},
            {"Hd_percent", s.hd},
            {"Hd_interval95_percent", {s.hd95.low, s.hd95.high}},
            {"position_mean_over_path_percent", json(s.positionMeanOverPath)},
            {"position_final_over_path_percent", json(s.positionFinalOverPath)},
            {"position_final_over_path_by_steps_percent", json(s.positionFinalOverPathBySteps)},
            {"position_mean_m", json(s.positionMean)},
            {"position_final_m", json(s.positionFinal)},
            {"heading_mean_rad", json(s.headingMean)},
            {"heading_final_rad", json(s.headingFinal)},
            {"final_along_m", json(s.along)},
            {"final_left_m", json(s.left)},
            {"final_heading_signed_rad", json(s.headingSigned)}};
}

namespace {

Json json(const PercentErrors& e) { return {{"P_percent", e.p}, {"Hd_percent", e.hd}}; }

Json json(const Assessment& model) {
    Json groups = Json::array(), overTime = Json::array(), relative = Json::array();
    for (const GroupSummary& group : model.groups)
        groups.push_back({{"by", group.kind}, {"name", group.name}, {"summary", json(group.summary)}});
    for (const ErrorsAt& at : model.overTime)
        overTime.push_back({{"t_s", at.time}, {"position_m", json(at.position)}, {"heading_rad", json(at.heading)}});
    for (const RelativePoseError& error : model.relative)
        relative.push_back({{"horizon_s", error.horizon},
                            {"pieces", error.pieces},
                            {"position_rms_m", error.position},
                            {"heading_rms_rad", error.heading}});
    return {{"name", model.name},
            {"all", json(model.all)},
            {"groups", std::move(groups)},
            {"relative_pose_error", std::move(relative)},
            {"error_over_time", std::move(overTime)},
            {"on_floor", json(model.onFloor)},
            {"on_turning_floor", json(model.onTurningFloor)}};
}

Json json(const std::optional<DriveAdvice>& advice) {
    if (!advice) return {};
    if (!advice->missing.empty()) return {{"missing", advice->missing}};
    return {{"drive", advice->drive}, {"reasons", advice->reasons}, {"command", advice->command}};
}

Json json(const ForecastAt::PerError& e) { return {{"along_m", e[0]}, {"across_m", e[1]}, {"heading_rad", e[2]}}; }

Json json(const Forecast& forecast) {
    const bool sampled = forecast.samples > 1;
    Json instants = Json::array(), foreseen = Json::array();
    for (const ForecastAt& at : forecast.at) {
        Json one{{"t_s", toSeconds(at.time)},
                 {"windows", at.ranks.size()},
                 {"energy_score_m", at.energy},
                 {"crps", json(at.ranked)}};
        if (sampled) {
            one["inside50"] = at.inside(0.5);
            one["inside90"] = at.inside(0.9);
            one["width50"] = json(at.half);
            one["width90"] = json(at.nineTenths);
        }
        instants.push_back(std::move(one));
    }
    for (const ErrorsAt& at : forecast.expected)
        foreseen.push_back({{"t_s", at.time}, {"position_m", json(at.position)}, {"heading_rad", json(at.heading)}});
    Json all{{"name", forecast.name},
             {"samples", forecast.samples},
             {"energy_score_sum_m", forecast.energy()},
             {"heading_crps_sum_rad", forecast.heading()},
             {"moves_energy_score_sum_m", forecast.moves},
             {"miss_points", forecast.miss()},
             {"instants", std::move(instants)}};
    if (sampled) all["foreseen_error_over_time"] = std::move(foreseen);
    return all;
}

Json json(const LogDefects& d) {
    return {{"out_of_order", d.outOfOrder},
            {"duplicates", d.duplicates},
            {"blips", d.blips},
            {"pose_outliers", d.poseOutliers},
            {"unpaired", d.unpaired},
            {"heading_wraps", d.headingWraps},
            {"command_gaps", d.commandGaps},
            {"pose_gaps", d.poseGaps},
            {"longest_command_gap_s", d.longestCommandGap},
            {"longest_pose_gap_s", d.longestPoseGap}};
}

Json json(const std::vector<LogFile>& files) {
    Json list = Json::array();
    for (const LogFile& file : files) list.push_back({{"path", file.path}, {"xxh3", file.hash}});
    return list;
}

Json json(const Floor& floor, const LogWindows& log) {
    Json pairs = Json::array();
    for (const FloorPair& pair : floor.pairs)
        pairs.push_back({{"robot", log.robots[pair.first.robot].name},
                         {"first_t_start", secondsText(pair.first.start)},
                         {"second_t_start", secondsText(pair.second.start)},
                         {"command_difference_of_bound", pair.commandDifference},
                         {"position_mean_m", pair.positionMean},
                         {"position_final_m", pair.positionFinal},
                         {"heading_mean_rad", pair.headingMean},
                         {"heading_final_rad", pair.headingFinal},
                         {"path_m", pair.path},
                         {"rotation_rad", pair.rotation}});
    return {{"path_bound_m", floor.options.pathBound},
            {"rotation_bound_rad", floor.options.rotationBound},
            {"lead_s", toSeconds(floor.options.lead)},
            {"least_turn_rate_rad_s", floor.options.leastTurnRate},
            {"horizon_s", toSeconds(floor.horizon)},
            {"stretches_tried", floor.tried},
            {"candidates", floor.candidates},
            {"pair_count", floor.pairs.size()},
            {"P_percent", floor.spread.p},
            {"Hd_percent", floor.spread.hd},
            {"P_best_percent", floor.best.p},
            {"Hd_best_percent", floor.best.hd},
            {"pairs", std::move(pairs)}};
}

Json floorJson(const std::optional<Floor>& floor, const LogWindows& log) { return floor ? json(*floor, log) : Json(); }

Json windowsJson(const Evaluation& evaluation, const ReportContext& context) {
    const LogWindows& log = evaluation.log;
    Json list = Json::array();
    for (std::size_t i = 0; i < log.windows.size(); ++i) {
        const Window& w = log.windows[i];
        Json errors = Json::array();
        for (const Assessment& model : evaluation.models) {
            const WindowErrors& e = model.errors[i];
            errors.push_back({{"position_mean_m", e.positionMean},
                              {"position_final_m", e.positionFinal},
                              {"heading_mean_rad", e.headingMean},
                              {"heading_final_rad", e.headingFinal}});
        }
        list.push_back({{"window", i + 1},
                        {"robot", log.robots[w.robot].name},
                        {"trajectory", log.trajectories[i]},
                        {"t_start", secondsText(w.start)},
                        {"duration_s", w.steps() * toSeconds(log.options.step)},
                        {"manoeuvre", name(w.manoeuvre)},
                        {"steady", w.steady},
                        {"path_m", w.path},
                        {"path_by_steps_m", w.pathBySteps},
                        {"rotation_rad", w.rotation},
                        {"unfamiliar", context.unfamiliar.empty() ? Json() : Json(context.unfamiliar[i])},
                        {"errors_by_model", std::move(errors)}});
    }
    return list;
}

Json logJson(const LogWindows& log) {
    Json robots = Json::array();
    for (const auto& robot : log.robots)
        robots.push_back({{"name", robot.name}, {"windows", robot.windows}, {"defects", json(robot.defects)}});
    return {{"source", log.source},       {"format", log.format},     {"dataset", log.dataset},
            {"synthetic", log.synthetic}, {"files", json(log.files)}, {"robots", std::move(robots)}};
}

}  // namespace

std::string resultsCsv(const Evaluation& evaluation) {
    const LogWindows& log = evaluation.log;
    std::string text =
        "model,window,dataset,robot,trajectory,t_start,manoeuvre,steady,path_m,path_by_steps_m,rotation_rad,"
        "position_mean_m,position_final_m,heading_mean_rad,heading_final_rad,final_along_m,final_left_m,"
        "final_heading_signed_rad\n";
    for (const Assessment& model : evaluation.models)
        for (std::size_t i = 0; i < log.windows.size(); ++i) {
            const Window& w = log.windows[i];
            const WindowErrors& e = model.errors[i];
            text += cat(csvCell(model.name), ",", std::to_string(i + 1), ",", std::to_string(log.dataset), ",",
                        csvCell(log.robots[w.robot].name), ",", csvCell(log.trajectories[i]), ",", secondsText(w.start),
                        ",", name(w.manoeuvre), w.steady ? ",1" : ",0");
            for (const double value : {w.path, w.pathBySteps, w.rotation, e.positionMean, e.positionFinal,
                                       e.headingMean, e.headingFinal, e.along, e.left, e.headingFinalSigned})
                text += cat(",", fixed(value, 6));
            text += "\n";
        }
    return text;
}

std::string resultsJson(const Evaluation& evaluation, const ReportContext& context) {
    Json facts = Json::object(), models = Json::array(), forecasts = Json::array();
    for (const auto& [key, value] : context.modelFacts) facts[key] = value;
    for (const Assessment& model : evaluation.models) models.push_back(json(model));
    for (const Forecast& forecast : evaluation.forecasts) forecasts.push_back(json(forecast));
    const WindowOptions& windows = evaluation.log.options;
    const Json all{{"program", context.program},
                   {"command_line", context.commandLine},
                   {"notices", context.notices},
                   {"log", logJson(evaluation.log)},
                   {"model_facts", std::move(facts)},
                   {"training_logs", json(context.trainingLogs)},
                   {"windows_rule",
                    {{"horizon_s", toSeconds(windows.horizon)},
                     {"step_s", toSeconds(windows.step)},
                     {"least_path_m", windows.leastPath},
                     {"least_rotation_rad", windows.leastRotation}}},
                   {"models", std::move(models)},
                   {"advice", json(context.advice)},
                   {"forecasts", std::move(forecasts)},
                   {"floor", floorJson(evaluation.log.floor, evaluation.log)},
                   {"turning_floor", floorJson(evaluation.log.turningFloor, evaluation.log)},
                   {"windows", windowsJson(evaluation, context)}};
    // Names may hold bytes that are no UTF-8: replaced, as in the report.
    return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mrose
