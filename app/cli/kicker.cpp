#include "kicker.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "io/format.h"
#include "report/kick_report.h"
#include "report/kick_text.h"

namespace mrose::cli {
namespace {

void printKicker(const TrainedKicker& trained, const std::string& file, double seconds) {
    const KickNetwork& n = trained.network;
    for (const std::string& notice : trained.notices) std::printf("Note: %s\n", notice.c_str());
    std::printf("%s%s: learned from %lld kicks, of which %lld met the ball, in %s\n", file.c_str(),
                n.learned.synthetic ? " (synthetic)" : "", static_cast<long long>(n.heldOut.kicks),
                static_cast<long long>(n.heldOut.hits), durationText(seconds).c_str());
    std::printf(
        "usual: dead time %s ms, %s m/s at full power; held out, mean log-likelihood: hit %s, delay %s, departure %s\n",
        fixed(1000 * n.constant.deadTime, 0).c_str(), fixed(n.constant.speedAtFull, 2).c_str(),
        fixed(n.heldOut.hit, 4).c_str(), fixed(n.heldOut.delay, 4).c_str(), fixed(n.heldOut.departure, 4).c_str());
}

std::string insideShares(const KickScores::Quantity& of) {
    return fixed(100 * of.inside50, 0) + " / " + fixed(100 * of.inside90, 0);
}

std::string likelihoodText(double value) { return std::isfinite(value) ? fixed(value, 3) : "-"; }

void printScores(const KickerEvaluation& evaluation, const EvaluateKickerRequest& request) {
    const KickScores& first = evaluation.scores.front();
    std::printf("%s%s: %zu kicks, of which %zu met the ball\n\n", request.log.c_str(),
                evaluation.synthetic ? " (synthetic)" : "", first.kicks, first.hits);
    TextTable table({evaluation.synthetic ? "synthetic" : "", "delay ms", "speed cm/s", "direction deg", "hit",
                     "delay ll", "departure ll", "delay 50 / 90 %", "speed 50 / 90 %", "direction 50 / 90 %"});
    for (const KickScores& of : evaluation.scores)
        table.add({of.name, fixed(1000 * of.quantities[0].crps, 2), fixed(100 * of.quantities[1].crps, 2),
                   fixed(degrees * of.quantities[2].crps, 2), fixed(of.hit, 4), likelihoodText(of.delay),
                   likelihoodText(of.departure), insideShares(of.quantities[0]), insideShares(of.quantities[1]),
                   insideShares(of.quantities[2])});
    std::fputs(table.text().c_str(), stdout);
    std::puts(
        "\ndelay, speed, direction: continuous ranked probability scores: mean absolute errors of what is predicted as "
        "a\ndistribution. hit: mean log-likelihood of whether the ball left; ll: of the densities of delay (1/s), and "
        "of "
        "speed\nand direction (s/m/rad). 50 / 90 %: real kicks in the central 50 and 90 % of what is predicted.");
    for (const std::string& notice : evaluation.context.notices) std::printf("Note: %s\n", notice.c_str());
}

}  // namespace

int runTrainKicker(const TrainKickerRequest& request, const CommonFlags& common) {
    const auto begin = std::chrono::steady_clock::now();
    watchInterrupts();
    LearningDisplay display(common.quiet, "learning");
    const auto trained = trainKicker(request, std::ref(display));
    display.end();
    if (!trained && wasInterrupted()) return reportInterrupted();
    if (!trained) return report(trained.error());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    if (common.json)
        std::puts(kickTrainingJson(trained->network, trained->notices, request.output, spent.count()).c_str());
    else
        printKicker(*trained, request.output, spent.count());
    return success;
}

int runEvaluateKicker(const EvaluateKickerRequest& request, const std::string& folder, const CommonFlags& common) {
    if (!folder.empty())
        if (const auto writable = checkKickReportFolder(folder, common.overwrite); !writable)
            return report(writable.error());
    const auto evaluated = evaluateKicker(request);
    if (!evaluated) return report(evaluated.error());
    const KickerEvaluation& e = *evaluated;
    if (common.json)
        std::puts(kickScoresJson(e.scores, e.synthetic, e.context.notices).c_str());
    else
        printScores(e, request);
    if (folder.empty()) return success;
    const KickReport page{request.log, e.synthetic, *e.kicker, e.samples.kicks, e.scores};
    if (const auto written = writeKickReport(page, e.context, folder); !written) return report(written.error());
    if (!common.json) std::printf("\nreport: %s\n", (std::filesystem::path(folder) / "report.html").string().c_str());
    return success;
}

}  // namespace mrose::cli
