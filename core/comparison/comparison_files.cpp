#include "comparison/comparison_files.h"

#include <cmath>

#include "evaluation/format.h"
#include "evaluation/html.h"
#include "evaluation/prediction_files.h"
#include "evaluation/results_json.h"

namespace mrose {
namespace {

std::string known(double value, int decimals) { return std::isfinite(value) ? fixed(value, decimals) : ""; }

bool hasTakes(const Comparison& comparison) { return comparison.takes.size() > 1; }

/// What begins a row about a course.
std::string keyOf(const Comparison& comparison, const ComparedCourse& course) {
    return windowKey(comparison.evaluation.dataset, comparison.robots[course.robot].realName, course.real.start);
}

std::string takeCell(const Comparison& comparison, const ComparedCourse& course) {
    return hasTakes(comparison) ? "," + csvCell(comparison.takes[comparison.requests[course.request].take]) : "";
}

nlohmann::ordered_json json(const ComparedSummary& summary) {
    return {{"courses", summary.courses()},
            {"windows", summary.of(CourseUse::counted)},
            {"still", summary.of(CourseUse::still)},
            {"gaps", summary.of(CourseUse::gap)},
            {"absent", summary.of(CourseUse::absent)},
            {"touches", summary.touches},
            {"courses_touched", summary.touched},
            {"position_final_m", mrose::json(summary.positionFinal)},
            {"heading_final_rad", mrose::json(summary.headingFinal)},
            {"summary", mrose::json(summary.counted)}};
}

nlohmann::ordered_json json(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json json(const ComparedDivergences::Summary& summary) {
    return {{"courses", summary.courses}, {"diverging", summary.diverging}, {"median_s", json(summary.medianTime)}};
}

nlohmann::ordered_json json(const CauseTrial& trial) {
    return {{"kind", name(trial.kind)}, {"what", trial.what}, {"explained", trial.explained}};
}

nlohmann::ordered_json json(const Comparison& comparison, const CourseDivergence& diverging) {
    const ComparedCourse& course = comparison.courses[diverging.course];
    const Divergence& divergence = diverging.divergence;
    nlohmann::ordered_json result{{"course", course.request + 1},
                                  {"name", comparison.robots[course.robot].name},
                                  {"robot", comparison.robots[course.robot].realName},
                                  {"start_s", toSeconds(comparison.requests[course.request].start)},
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
    result["cause"] = diagnosis.likely ? json(diagnosis.trials[*diagnosis.likely]) : nlohmann::ordered_json();
    result["tried"] = nlohmann::ordered_json::array();
    if (diagnosis.parting)
        result["parting"] = {
            {"from_s", toSeconds(diagnosis.parting->from)}, {"to_s", toSeconds(diagnosis.parting->to)},
            {"ahead_m", diagnosis.parting->ahead},          {"left_m", diagnosis.parting->left},
            {"turn_rad", diagnosis.parting->turn},          {"explained", diagnosis.parting->explained}};
    for (const CauseTrial& trial : diagnosis.trials) result["tried"].push_back(json(trial));
    return result;
}

nlohmann::ordered_json json(const Comparison& comparison, const ComparedDivergences& divergences) {
    nlohmann::ordered_json result{{"bound",
                                   {{"from_held_out", divergences.fromHeldOut},
                                    {"position_m", divergences.bound.constant.position},
                                    {"heading_rad", divergences.bound.constant.heading},
                                    {"held_s", toSeconds(divergences.bound.held)}}},
                                  {"all", json(divergences.all)}};
    if (divergences.fromHeldOut)
        for (const char* constant : {"position_m", "heading_rad"}) result["bound"].erase(constant);
    result["robots"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) {
        nlohmann::ordered_json robot{{"name", comparison.robots[i].name}, {"robot", comparison.robots[i].realName}};
        robot.update(json(divergences.robots[i]));
        result["robots"].push_back(std::move(robot));
    }
    result["courses"] = nlohmann::ordered_json::array();
    for (const CourseDivergence& diverging : divergences.courses)
        result["courses"].push_back(json(comparison, diverging));
    return result;
}

/// Empty where it does not diverge, or where the cause was not looked for.
std::string divergenceCells(const CourseDivergence* diverging) {
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
    nlohmann::ordered_json robots = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) {
        nlohmann::ordered_json robot{{"name", comparison.robots[i].name}, {"robot", comparison.robots[i].realName}};
        robot.update(json(comparison.summaries[i]));
        robots.push_back(std::move(robot));
    }
    nlohmann::ordered_json result{{"scenario", comparison.scenario},
                                  {"log", comparison.evaluation.source},
                                  {"dataset", comparison.evaluation.dataset},
                                  {"seed", comparison.seed},
                                  {"notices", notices},
                                  {"all", json(comparison.all)},
                                  {"robots", std::move(robots)},
                                  {"touches", comparison.touches},
                                  {"faults", comparison.faults},
                                  {"first_fault", comparison.firstFault}};
    if (divergences != nullptr) result["divergence"] = json(comparison, *divergences);
    return result.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string errorsCsv(const Comparison& comparison) {
    const Nanoseconds step = comparison.evaluation.options.windows.step;
    std::string text =
        "dataset,robot,t_start,t,x,y,heading,real_x,real_y,real_heading,position_error_m,heading_error_rad,simulated";
    text += hasTakes(comparison) ? ",trajectory\n" : "\n";
    for (const ComparedCourse& course : comparison.courses) {
        const std::string key = keyOf(comparison, course);
        const std::string end =
            "," + csvCell(comparison.robots[course.robot].name) + takeCell(comparison, course) + "\n";
        for (std::size_t k = 0; k < course.simulated.size(); ++k) {
            const Pose &simulated = course.simulated[k], &real = course.real.truth[k + 1];
            text += cat(key, ",", secondsText(static_cast<Nanoseconds>(k + 1) * step), ",", fixed(simulated.x, 7), ",",
                        fixed(simulated.y, 7), ",", fixed(simulated.heading, 7), ",", known(real.x, 7), ",",
                        known(real.y, 7), ",", known(real.heading, 7), ",", known(course.errors.position[k], 7), ",",
                        known(course.errors.heading[k], 7), end);
        }
    }
    return text;
}

std::string coursesCsv(const Comparison& comparison, const ComparedDivergences* divergences) {
    const Nanoseconds step = comparison.evaluation.options.windows.step;
    std::string text =
        "course,dataset,robot,t_start,start_s,duration_s,use,path_m,rotation_rad,position_mean_m,position_final_m,"
        "heading_mean_rad,heading_final_rad,touches,touched_s,simulated";
    text += hasTakes(comparison) ? ",trajectory" : "";
    text += divergences != nullptr ? ",diverged_s,cause\n" : "\n";
    for (std::size_t i = 0; i < comparison.courses.size(); ++i) {
        const ComparedCourse& course = comparison.courses[i];
        const CourseRequest& request = comparison.requests[course.request];
        const WindowErrors& errors = course.errors;
        const auto cell = [&](double value) { return course.simulated.empty() ? "" : known(value, 7); };
        text += cat(std::to_string(course.request + 1), ",", keyOf(comparison, course), ",", secondsText(request.start),
                    ",", secondsText(request.steps * step), ",", name(course.use), ",", known(course.real.path, 4), ",",
                    known(course.real.rotation, 4), ",", cell(errors.positionMean), ",", cell(errors.positionFinal),
                    ",", cell(errors.headingMean), ",", cell(errors.headingFinal), ",", std::to_string(course.touches),
                    ",", course.touched ? secondsText(*course.touched) : "", ",",
                    csvCell(comparison.robots[course.robot].name), takeCell(comparison, course));
        if (divergences != nullptr) text += divergenceCells(divergences->of(i));
        text += '\n';
    }
    return text;
}

}  // namespace mrose
