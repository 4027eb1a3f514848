#include "workflow/evaluate_kicker.h"

#include <algorithm>
#include <filesystem>

#include "io/format.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/train_kicker.h"

namespace mrose {
namespace {

ReportContext kickerContext(const KickNetwork& network, const EvaluateKickerRequest& request) {
    const NetworkTraining& training = network.learned.training;
    ReportContext context = contextOf(training, request.command);
    const auto fact = [&](const char* name, std::string value) {
        context.modelFacts.emplace_back(name, std::move(value));
    };
    fact("file", request.network);
    fact("kicker of", network.robotType + (network.learned.synthetic ? " (synthetic)" : ""));
    fact("distributions", counted(static_cast<std::size_t>(network.members), "member") + " of " +
                              counted(static_cast<std::size_t>(network.components), "normal distribution"));
    const KickNetwork::Constant& c = network.constant;
    fact("analytic", "dead time " + fixed(1000 * c.deadTime, 0) + " ms, " + fixed(c.speedAtFull, 2) +
                         " m/s at full power and the robot's own, direction " + fixed(degrees * network.direction, 1) +
                         "°");
    fact("its noise", fixed(1000 * c.delaySpread, 1) + " ms, " + fixed(c.speedSpread, 2) + " m/s, " +
                          fixed(degrees * c.directionSpread, 1) + "°");
    fact("learned by", training.method + ", seed " + std::to_string(training.seed) + ", " +
                           std::to_string(training.patterns) + " kicks, " + std::to_string(training.epochs) +
                           " epochs");
    fact("command", training.command);
    return context;
}

}  // namespace

Expected<KickerEvaluation> evaluateKicker(const EvaluateKickerRequest& request) {
    auto network = loadKick(request.network);
    if (!network) return tl::unexpected(network.error());
    auto log = openLog(request.log, request.robots);
    if (!log) return tl::unexpected(log.error());
    KickerEvaluation evaluation;
    evaluation.synthetic = log->synthetic;
    evaluation.context = kickerContext(*network, request);
    std::vector<std::string>& notices = evaluation.context.notices;
    notices = noticesOf(*log);
    const auto& sources = network->learned.training.logs;
    if (std::ranges::any_of(log->files, [&](const LogFile& file) {
            return std::ranges::any_of(sources, [&](const NetworkSource& from) { return from.hash == file.hash; });
        }))
        notices.emplace_back("The network was learned from this very log: the figures are too good.");
    const std::string source = log->source;
    std::vector<Log> logs;
    logs.push_back(std::move(*log));
    evaluation.samples = kickSamples(logs);
    if (evaluation.samples.hits() == 0)
        return fail(source, evaluation.samples.commanded == 0
                                ? "holds no kicks (column kick) to judge a kicker by"
                                : "holds no kick that meets a tracked ball, to judge a kicker by");
    for (std::string& notice : noticesOf(evaluation.samples)) notices.push_back(std::move(notice));
    if (evaluation.synthetic) notices.emplace_back("The log is synthetic: no real kicker kicked.");
    const std::string name = std::filesystem::path(request.network).filename().string();
    evaluation.kicker = std::make_shared<const LearnedKicker>(std::move(*network));
    evaluation.scores = scoreKicks(*evaluation.kicker, evaluation.samples.kicks, name);
    return evaluation;
}

}  // namespace mrose
