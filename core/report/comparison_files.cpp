#include "report/comparison_files.h"

#include <algorithm>

#include "assessment/prediction_files.h"
#include "io/format.h"
#include "report/page.h"
#include "report/results_json.h"
#include "report/stream_json.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

using Json = nlohmann::ordered_json;

bool hasSessions(const Comparison& comparison) { return comparison.sessions.size() > 1; }

/// What begins a row about a rollout.
std::string keyOf(const Comparison& comparison, const ComparedRollout& rollout) {
    return windowKey(comparison.log.dataset, comparison.robots[rollout.robot].realName, rollout.real.start);
}

std::string sessionCell(const Comparison& comparison, const ComparedRollout& rollout) {
    return hasSessions(comparison) ? "," + csvCell(comparison.sessions[comparison.requests[rollout.request].session])
                                   : "";
}

Json json(const ComparedSummary& summary) {
    return {{"rollouts", summary.rollouts()},
            {"windows", summary.of(RolloutUse::counted)},
            {"still", summary.of(RolloutUse::still)},
            {"gaps", summary.of(RolloutUse::gap)},
            {"absent", summary.of(RolloutUse::absent)},
            {"touches", summary.touches},
            {"courses_touched", summary.touched},
            {"position_final_m", mrose::json(summary.positionFinal)},
            {"heading_final_rad", mrose::json(summary.headingFinal)},
            {"summary", mrose::json(summary.counted)}};
}

Json json(const ComparedDivergences::Summary& summary) {
    return {{"rollouts", summary.rollouts}, {"diverging", summary.diverging}, {"median_s", summary.medianTime}};
}

Json json(const CauseTrial& trial) {
    return {{"kind", name(trial.kind)}, {"what", trial.what}, {"explained", trial.explained}};
}

Json json(const Comparison& comparison, const RolloutDivergence& diverging) {
    const ComparedRollout& rollout = comparison.rollouts[diverging.rollout];
    const Divergence& divergence = diverging.divergence;
    Json result{{"rollout", rollout.request + 1},
                {"name", comparison.robots[rollout.robot].name},
                {"robot", comparison.robots[rollout.robot].realName},
                {"start_s", toSeconds(comparison.requests[rollout.request].start)},
                {"time_s", toSeconds(divergence.time)},
                {"within_until_s", toSeconds(divergence.within)},
                {"position_m", divergence.position},
                {"heading_rad", divergence.heading},
                {"bound_m", divergence.bound.position},
                {"bound_rad", divergence.bound.heading},
                {"by_position", divergence.byPosition},
                {"by_heading", divergence.byHeading}};
    if (!diverging.diagnosis) return result;
    const Diagnosis& diagnosis = *diverging.diagnosis;
    result["cause"] = diagnosis.likely ? json(diagnosis.trials[*diagnosis.likely]) : Json();
    result["tried"] = Json::array();
    if (diagnosis.onset)
        result["onset"] = {{"from_s", toSeconds(diagnosis.onset->from)}, {"to_s", toSeconds(diagnosis.onset->to)},
                           {"ahead_m", diagnosis.onset->ahead},          {"left_m", diagnosis.onset->left},
                           {"turn_rad", diagnosis.onset->turn},          {"explained", diagnosis.onset->explained}};
    for (const CauseTrial& trial : diagnosis.trials) result["tried"].push_back(json(trial));
    return result;
}

constexpr const char* boundSourceNames[] = {"constant", "held_out", "noise"};

Json json(const Comparison& comparison, const ComparedDivergences& divergences) {
    Json result{{"bound",
                 {{"from", boundSourceNames[static_cast<std::size_t>(divergences.source)]},
                  {"position_m", divergences.bound.constant.position},
                  {"heading_rad", divergences.bound.constant.heading},
                  {"held_s", toSeconds(divergences.bound.held)}}},
                {"all", json(divergences.all)}};
    if (divergences.source != BoundSource::constant)
        for (const char* constant : {"position_m", "heading_rad"}) result["bound"].erase(constant);
    result["robots"] = Json::array();
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) {
        Json robot{{"name", comparison.robots[i].name}, {"robot", comparison.robots[i].realName}};
        robot.update(json(divergences.robots[i]));
        result["robots"].push_back(std::move(robot));
    }
    result["rollouts"] = Json::array();
    for (const RolloutDivergence& diverging : divergences.rollouts)
        result["rollouts"].push_back(json(comparison, diverging));
    return result;
}

/// Which of the rollouts a look is of.
const ComparedRollout& rolloutOf(const Comparison& comparison, const SensedLook& look) {
    const auto first = std::ranges::lower_bound(comparison.rollouts, look.request, {}, &ComparedRollout::request);
    return *std::find_if(first, comparison.rollouts.end(),
                         [&](const ComparedRollout& rollout) { return rollout.robot == look.robot; });
}

void addLook(const Comparison& comparison, const std::string& sensor, const char* stream, const SensedLook& look,
             std::string& text) {
    const std::string begin = cat(std::to_string(look.request + 1), ",", keyOf(comparison, rolloutOf(comparison, look)),
                                  ",", csvCell(sensor), ",", stream, ",", secondsText(look.time), ",");
    const std::string end = "," + csvCell(comparison.robots[look.robot].name) + "\n";
    if (look.subjects.empty()) text += begin + ",,,,,," + end;
    for (const SensedSubject& subject : look.subjects) {
        text += cat(begin, csvCell(comparison.subjects[subject.subject]), subject.inView ? ",1," : ",0,",
                    fixed(subject.range, 5), ",", fixed(subject.bearing, 6), subject.reported ? ",1," : ",0,");
        if (subject.reported)
            text += cat(fixed(subject.reportedRange(), 5), ",", fixed(subject.reportedBearing(), 6));
        else
            text += ",";
        text += end;
    }
}

/// Empty where it does not diverge, or where the cause was not looked for.
std::string divergenceCells(const RolloutDivergence* diverging) {
    if (diverging == nullptr) return ",,";
    const auto& diagnosis = diverging->diagnosis;
    const std::string cause = !diagnosis          ? ""
                              : diagnosis->likely ? diagnosis->trials[*diagnosis->likely].what
                                                  : "none of these";
    return "," + secondsText(diverging->divergence.time) + "," + csvCell(cause);
}

}  // namespace

std::string comparisonJson(const Comparison& comparison, const std::vector<std::string>& notices,
                           const ComparedDivergences* divergences) {
    Json robots = Json::array();
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) {
        Json robot{{"name", comparison.robots[i].name}, {"robot", comparison.robots[i].realName}};
        robot.update(json(comparison.summaries[i]));
        robots.push_back(std::move(robot));
    }
    Json result{{"scenario", comparison.scenario},
                {"log", comparison.log.source},
                {"dataset", comparison.log.dataset},
                {"seed", comparison.seed},
                {"notices", notices},
                {"all", json(comparison.all)},
                {"robots", std::move(robots)},
                {"touches", comparison.touches},
                {"faults", comparison.faults},
                {"first_fault", comparison.firstFault}};
    if (!comparison.sensors.empty()) result["sensors"] = streamsJson(comparison);
    if (divergences != nullptr) result["divergence"] = json(comparison, *divergences);
    return result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string readingsCsv(const Comparison& comparison) {
    std::string text =
        "rollout,dataset,robot,t_start,sensor,stream,t,subject,in_view,true_range_m,true_bearing_rad,reported,range_m,"
        "bearing_rad,simulated\n";
    for (const ComparedSensor& sensor : comparison.sensors)
        for (const auto& [stream, looks] :
             {std::pair("real", &sensor.looks.real), std::pair("simulated", &sensor.looks.simulated)})
            for (const SensedLook& look : *looks) addLook(comparison, sensor.name, stream, look, text);
    return text;
}

std::string errorsCsv(const Comparison& comparison) {
    const Nanoseconds step = comparison.log.options.step;
    std::string text =
        "dataset,robot,t_start,t,x,y,heading,real_x,real_y,real_heading,position_error_m,heading_error_rad,simulated";
    text += hasSessions(comparison) ? ",trajectory\n" : "\n";
    for (const ComparedRollout& rollout : comparison.rollouts) {
        const std::string key = keyOf(comparison, rollout);
        const std::string end =
            "," + csvCell(comparison.robots[rollout.robot].name) + sessionCell(comparison, rollout) + "\n";
        for (std::size_t k = 0; k < rollout.simulated.size(); ++k) {
            const Pose &simulated = rollout.simulated[k], &real = rollout.real.truth[k + 1];
            text += cat(key, ",", secondsText(static_cast<Nanoseconds>(k + 1) * step), ",", fixed(simulated.x, 7), ",",
                        fixed(simulated.y, 7), ",", fixed(simulated.heading, 7), ",", knownText(real.x, 7), ",",
                        knownText(real.y, 7), ",", knownText(real.heading, 7), ",",
                        knownText(rollout.errors.position[k], 7), ",", knownText(rollout.errors.heading[k], 7), end);
        }
    }
    return text;
}

std::string rolloutsCsv(const Comparison& comparison, const ComparedDivergences* divergences) {
    const Nanoseconds step = comparison.log.options.step;
    std::string text =
        "rollout,dataset,robot,t_start,start_s,duration_s,use,path_m,rotation_rad,position_mean_m,position_final_m,"
        "heading_mean_rad,heading_final_rad,touches,touched_s,simulated";
    text += hasSessions(comparison) ? ",trajectory" : "";
    text += divergences != nullptr ? ",diverged_s,cause\n" : "\n";
    for (std::size_t i = 0; i < comparison.rollouts.size(); ++i) {
        const ComparedRollout& rollout = comparison.rollouts[i];
        const RolloutRequest& request = comparison.requests[rollout.request];
        const WindowErrors& errors = rollout.errors;
        const auto cell = [&](double value) { return rollout.simulated.empty() ? "" : knownText(value, 7); };
        text +=
            cat(std::to_string(rollout.request + 1), ",", keyOf(comparison, rollout), ",", secondsText(request.start),
                ",", secondsText(request.steps * step), ",", name(rollout.use), ",", knownText(rollout.real.path, 4),
                ",", knownText(rollout.real.rotation, 4), ",", cell(errors.positionMean), ",",
                cell(errors.positionFinal), ",", cell(errors.headingMean), ",", cell(errors.headingFinal), ",",
                std::to_string(rollout.touches), ",", rollout.touched ? secondsText(*rollout.touched) : "", ",",
                csvCell(comparison.robots[rollout.robot].name), sessionCell(comparison, rollout));
        if (divergences != nullptr) text += divergenceCells(divergences->of(i));
        text += '\n';
    }
    return text;
}

}  // namespace mrose
