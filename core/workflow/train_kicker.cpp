#include "workflow/train_kicker.h"

#include <algorithm>
#include <set>

#include "io/file.h"
#include "io/format.h"
#include "logs/unit_doubts.h"
#include "workflow/learning_logs.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"

namespace mrose {
namespace {

Expected<void> checkKicks(const Log& log) {
    std::size_t kicks = 0, ball = 0;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            kicks += trajectory.kicks.size();
            ball += trajectory.ball.size();
        }
    if (kicks == 0) return fail(log.source, "holds no kicks (column kick), of which a kicker could be learned");
    if (ball == 0) return fail(log.source, "holds no ball (columns ball_x and ball_y)");
    return {};
}

std::vector<std::string> noticesOfInputs(const KickNetwork& network) {
    std::vector<std::string> notices;
    const KickNetwork::Range& power = network.seen[0];
    if (power.most - power.least < 1e-6)
        notices.push_back("All kicks are of power " + fixed(power.least, 2) +
                          ": what another power does is not known, and taken to be the same.");
    if (network.seen[1].most - network.seen[1].least < 0.02)
        notices.emplace_back(
            "The robot stood at all kicks: what its motion does is not known, and taken to be nothing.");
    if (network.constant.hits == 1)
        notices.emplace_back("All kicks met the ball: where they would miss it is not known beyond where it lay.");
    return notices;
}

}  // namespace

std::vector<std::string> noticesOf(const KickSamples& samples) {
    std::vector<std::string> notices;
    const auto add = [&](std::size_t count, const char* why) {
        if (count > 0) notices.push_back("Left out: " + counted(count, "kick") + ' ' + why);
    };
    add(samples.unseen, "at which ball or robot was not tracked.");
    add(samples.unclear, "before which the ball moved, or after which it did not leave as a kicked one does.");
    add(samples.far, "at a ball that lay farther away than any that was hit.");
    return notices;
}

Expected<TrainedKicker> trainKicker(const TrainKickerRequest& request, const Progress& progress) {
    std::vector<std::string> read;
    for (const std::string& log : request.logs) read.push_back(placeOfLog(log));
    if (!request.output.empty())
        if (auto can = checkOutput(request.output, read, request.overwrite); !can) return tl::unexpected(can.error());
    std::vector<Log> logs;
    TrainedKicker trained;
    NetworkTraining sources;
    bool synthetic = false;
    for (const std::string& source : request.logs) {
        auto log = openLog(source, request.robots);
        if (!log) return tl::unexpected(log.error());
        if (auto has = checkKicks(*log); !has) return tl::unexpected(has.error());
        if (auto fits = checkMetres(*log); !fits) return tl::unexpected(fits.error());
        for (std::string& notice : noticesOf(*log)) trained.notices.push_back(std::move(notice));
        for (const LogFile& file : log->files) sources.logs.push_back({file.path, file.hash});
        synthetic = synthetic || log->synthetic;
        logs.push_back(std::move(*log));
    }
    const auto traits = traitsOf(request.robotKind, logs.front());
    if (!traits) return tl::unexpected(traits.error());
    trained.samples = kickSamples(logs);
    auto network = trainKicker(trained.samples, request.training, progress);
    if (!network) {
        Error error = network.error();
        for (const Log& log : logs) error.cause = withUnitDoubts(error.cause, log);
        return atFile(std::move(error), logs.front().source);
    }
    trained.network = std::move(*network);
    trained.network.robotType = traits->type;
    trained.network.learned.synthetic = synthetic;
    trained.network.learned.training.command = request.command;
    trained.network.learned.training.logs = sources.logs;
    for (const auto& some : {noticesOf(trained.samples), noticesOfInputs(trained.network)})
        trained.notices.insert(trained.notices.end(), some.begin(), some.end());
    if (synthetic) trained.notices.emplace_back("The log is synthetic: no real kicker kicked.");
    if (request.output.empty()) return trained;
    if (auto saved = writeFileAtomically(request.output, kickText(trained.network)); !saved)
        return tl::unexpected(saved.error());
    return trained;
}

}  // namespace mrose
