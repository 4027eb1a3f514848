#include "evaluate_sensor.h"

#include <cstdio>
#include <filesystem>

#include "io/format.h"
#include "report/sensor_files.h"
#include "report/sensor_report.h"

namespace mrose::cli {
namespace {

std::string insideText(const ErrorScores& error) {
    return fixed(100 * error.inside50, 1) + " / " + fixed(100 * error.inside90, 1);
}

void printTable(const SensorEvaluation& evaluation, const std::vector<std::string>& notices) {
    const LoggedCases& log = evaluation.log;
    std::string robots;
    for (const LoggedCases::Robot& robot : log.robots) robots += (robots.empty() ? "" : ", ") + robot.name;
    std::printf("%s%s, %s of robot %s: %zu looks, %zu subjects to report, %zu reported\n\n", log.source.c_str(),
                log.synthetic ? " (synthetic)" : "", log.sensor.c_str(), robots.c_str(), log.looks.size(),
                log.cases.size(), evaluation.models.front().all.readings);
    std::vector<std::string> header{log.synthetic ? "synthetic" : "", "range cm"};
    for (const LoggedCases::Robot& robot : log.robots) header.push_back("bearing " + robot.name + " mrad");
    for (const char* name : {"detection", "off %", "range 50 / 90 %", "bearing 50 / 90 %"}) header.emplace_back(name);
    TextTable table(header);
    for (const SensorAssessment& model : evaluation.models) {
        std::vector<std::string> row{model.name, fixed(100 * model.all.error[0].crps, 2)};
        for (const SensorScores& robot : model.byRobot) row.push_back(fixed(1000 * robot.error[1].crps, 2));
        row.push_back(fixed(model.all.detection, 4));
        row.push_back(fixed(100 * model.all.off, 1));
        for (const ErrorScores& error : model.all.error) row.push_back(insideText(error));
        table.add(row);
    }
    std::fputs(table.text().c_str(), stdout);
    std::puts(
        "\nrange, bearing: continuous ranked probability scores: mean absolute errors of what is predicted as a "
        "distribution.\n"
        "detection: mean log-likelihood of what was and was not reported. off: the worst of ten groups, by how likely\n"
        "a report was, between the predicted and the real share. 50 / 90 %: real readings in the central 50 and 90 % "
        "of\nwhat is predicted.");
    if (!notices.empty()) std::puts("");
    for (const std::string& notice : notices) std::printf("Note: %s\n", notice.c_str());
}

}  // namespace

int runEvaluateSensor(const EvaluateSensorRequest& request, const std::string& folder, const CommonFlags& common) {
    if (!folder.empty())
        if (const auto writable = checkSensorReportFolder(folder, common.overwrite); !writable)
            return report(writable.error());
    watchInterrupts();
    LearningDisplay display(common.quiet, "learning the other families");
    const auto evaluated = evaluateSensor(request, std::ref(display), goesOn);
    display.end();
    if (wasInterrupted()) return reportInterrupted();
    if (!evaluated) return report(evaluated.error());
    const auto& [evaluation, context] = *evaluated;
    if (common.json)
        std::puts(sensorResultsJson(evaluation, context).c_str());
    else
        printTable(evaluation, context.notices);
    if (folder.empty()) return success;
    if (const auto written = writeSensorReport(evaluation, context, folder); !written) return report(written.error());
    if (!common.json) std::printf("\nreport: %s\n", (std::filesystem::path(folder) / "report.html").string().c_str());
    return success;
}

}  // namespace mrose::cli
