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

}  // namespace

std::string comparisonJson(const Comparison& comparison, const std::vector<std::string>& notices) {
    nlohmann::ordered_json robots = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) {
        nlohmann::ordered_json robot{{"name", comparison.robots[i].name}, {"robot", comparison.robots[i].realName}};
        robot.update(json(comparison.summaries[i]));
        robots.push_back(std::move(robot));
    }
    const nlohmann::ordered_json result{{"scenario", comparison.scenario},
                                        {"log", comparison.evaluation.source},
                                        {"dataset", comparison.evaluation.dataset},
                                        {"seed", comparison.seed},
                                        {"notices", notices},
                                        {"all", json(comparison.all)},
                                        {"robots", std::move(robots)},
                                        {"touches", comparison.touches},
                                        {"faults", comparison.faults},
                                        {"first_fault", comparison.firstFault}};
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

std::string coursesCsv(const Comparison& comparison) {
    const Nanoseconds step = comparison.evaluation.options.windows.step;
    std::string text =
        "course,dataset,robot,t_start,start_s,duration_s,use,path_m,rotation_rad,position_mean_m,position_final_m,"
        "heading_mean_rad,heading_final_rad,touches,touched_s,simulated";
    text += hasTakes(comparison) ? ",trajectory\n" : "\n";
    for (const ComparedCourse& course : comparison.courses) {
        const CourseRequest& request = comparison.requests[course.request];
        const WindowErrors& errors = course.errors;
        const auto cell = [&](double value) { return course.simulated.empty() ? "" : known(value, 7); };
        text += cat(std::to_string(course.request + 1), ",", keyOf(comparison, course), ",", secondsText(request.start),
                    ",", secondsText(request.steps * step), ",", name(course.use), ",", known(course.real.path, 4), ",",
                    known(course.real.rotation, 4), ",", cell(errors.positionMean), ",", cell(errors.positionFinal),
                    ",", cell(errors.headingMean), ",", cell(errors.headingFinal), ",", std::to_string(course.touches),
                    ",", course.touched ? secondsText(*course.touched) : "", ",",
                    csvCell(comparison.robots[course.robot].name), takeCell(comparison, course), "\n");
    }
    return text;
}

}  // namespace mrose
