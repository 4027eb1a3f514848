#include "learning_logs.h"

#include <algorithm>
#include <cmath>

#include "common.h"
#include "identification/drive_fit.h"
#include "identification/held_out_groups.h"
#include "shared/notices.h"

namespace mrose::cli {
namespace {

Expected<std::vector<Log>> openAll(const LearningLogsRequest& request, const std::optional<DifferentialDrive>& drive) {
    std::vector<Log> logs;
    for (const std::string& source : request.sources) {
        auto log = openLog(source, request.robots, drive);
        if (!log) return tl::unexpected(log.error());
        if (request.holdOut.holdsAny()) {
            if (const auto kept = partOf(*log, request.holdOut, LogPart::heldOut); !kept)
                return tl::unexpected(kept.error());
            log = partOf(std::move(*log), request.holdOut, LogPart::learned);
            if (!log) return tl::unexpected(log.error());
        }
        logs.push_back(std::move(*log));
    }
    return logs;
}

/// A log given twice would be learned from and held out at once.
Expected<void> checkDifferent(const std::vector<Log>& logs) {
    for (std::size_t i = 0; i < logs.size(); ++i)
        for (const LogFile& file : logs[i].files)
            for (std::size_t k = 0; k < i; ++k)
                for (const LogFile& other : logs[k].files)
                    if (other.hash == file.hash) return fail(file.path, "is given twice: as " + other.path + " too");
    return {};
}

/// One network is of one kind of robot.
Expected<void> checkSameKind(const std::vector<Log>& logs) {
    const Log& first = logs.front();
    for (const Log& log : logs) {
        const std::string kind = robotKind(log), firstKind = robotKind(first);
        const bool otherKind = kind != firstKind && !kind.empty() && !firstKind.empty();
        const bool otherCommands = (log.format == "husky-windows") != (first.format == "husky-windows");
        if (otherKind || otherCommands) return fail(log.source, "is of another kind of robot than " + first.source);
    }
    return {};
}

}  // namespace

Expected<LearningLogs> openLearningLogs(const LearningLogsRequest& request) {
    auto logs = openAll(request, {});
    if (!logs) return tl::unexpected(logs.error());
    for (const auto& check : {checkDifferent, checkSameKind})
        if (const auto fits = check(*logs); !fits) return tl::unexpected(fits.error());
    if (logs->front().format != "husky-windows") return LearningLogs{std::move(*logs), {}};
    const auto fit = fitDrive(steadyMotions(logs->front(), WheelSource::commands), logs->front().source);
    if (!fit) return tl::unexpected(fit.error());
    logs = openAll(request, fit->drive);
    if (!logs) return tl::unexpected(logs.error());
    return LearningLogs{std::move(*logs), fit->drive};
}

HoldOut holdOutShare(double share, int part) {
    if (share <= 0) return {};
    const int every = std::max(2, static_cast<int>(std::lround(1 / share)));
    return {every, (part % every + every - 1) % every};
}

}  // namespace mrose::cli
