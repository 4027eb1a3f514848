#include "workflow/evaluate_localiser.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "evaluate_sensor.h"
#include "io/format.h"
#include "report/localiser_report.h"

namespace mrose::cli {
namespace {

void printLocaliser(const LocaliserEvaluation& evaluation) {
    const LocaliserScores& first = evaluation.scores.front();
    std::printf("%s%s, %s: %s, %s reported, %zu of them gross errors\n\n", evaluation.log.c_str(),
                evaluation.synthetic ? " (synthetic)" : "", evaluation.network.sensor.c_str(),
                counted(first.cases, "instant").c_str(), counted(first.readings, "pose").c_str(),
                first.readings - first.sound);
    TextTable table({evaluation.synthetic ? "synthetic" : "", "ahead cm", "left cm", "heading deg", "report", "pose",
                     "ahead 50 / 90 %", "left 50 / 90 %", "heading 50 / 90 %"});
    for (const LocaliserScores& of : evaluation.scores) {
        const auto inside = [&](std::size_t d) {
            return fixed(100 * of.error[d].inside50, 0) + " / " + fixed(100 * of.error[d].inside90, 0);
        };
        table.add({of.name, fixed(100 * of.error[0].crps, 2), fixed(100 * of.error[1].crps, 2),
                   fixed(degrees * of.error[2].crps, 2), fixed(of.detection, 4),
                   std::isfinite(of.logDensity) ? fixed(of.logDensity, 3) : "-", inside(0), inside(1), inside(2)});
    }
    std::fputs(table.text().c_str(), stdout);
    std::puts(
        "\nahead, left, heading: continuous ranked probability scores of a pose's errors in the robot's true frame: "
        "mean\n"
        "absolute errors of what is predicted as a distribution. report: mean log-likelihood of whether a pose was\n"
        "reported; pose: of the density of its errors (1/m2/rad). 50 / 90 %: poses in the central 50 and 90 % of what "
        "is\n"
        "predicted.");
    if (!evaluation.context.notices.empty()) std::puts("");
    for (const std::string& notice : evaluation.context.notices) std::printf("Note: %s\n", notice.c_str());
}

}  // namespace

int runEvaluateLocaliser(const EvaluateSensorRequest& request, const std::string& folder, const CommonFlags& common) {
    if (!folder.empty())
        if (const auto writable = checkLocaliserReportFolder(folder, common.overwrite); !writable)
            return report(writable.error());
    watchInterrupts();
    LearningDisplay display(common.quiet, "learning the other families");
    const auto evaluated = evaluateLocaliser(request, std::ref(display));
    display.end();
    if (wasInterrupted()) return reportInterrupted();
    if (!evaluated) return report(evaluated.error());
    const LocaliserEvaluation& e = *evaluated;
    const LocaliserReport page{e.log, e.synthetic, e.network, e.cases, e.scores};
    if (common.json)
        std::puts(localiserScoresJson(page, e.context).c_str());
    else
        printLocaliser(e);
    if (folder.empty()) return success;
    if (const auto written = writeLocaliserReport(page, e.context, folder); !written) return report(written.error());
    if (!common.json) std::printf("\nreport: %s\n", (std::filesystem::path(folder) / "report.html").string().c_str());
    return success;
}

}  // namespace mrose::cli
