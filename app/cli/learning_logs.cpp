#include "learning_logs.h"

#include <algorithm>

#include "common.h"
#include "identification/drive_fit.h"
#include "identification/held_out_part.h"
#include "logs/log_reader.h"
#include "workflow/notices.h"

namespace mrose::cli {
namespace {

/// Robots without commands or without ground truth teach nothing, unless they were asked for.
void leaveOutHalves(Log& log) {
    if (std::none_of(log.robots.begin(), log.robots.end(), hasBothSides)) return;
    for (const RobotLog& robot : log.robots)
        if (!hasBothSides(robot))
            log.incomplete.push_back("Nothing is learned from robot \"" + robot.robot + "\": the log has no " +
                                     missingSide(robot) + " of it.");
    std::erase_if(log.robots, [](const RobotLog& robot) { return !hasBothSides(robot); });
}

Expected<std::vector<Log>> openAll(const LearningLogsRequest& request, const std::optional<DifferentialDrive>& drive) {
    std::vector<Log> logs;
    for (const std::string& source : request.sources) {
        auto log = openLog(source, request.robots, drive);
        if (!log) return tl::unexpected(log.error());
        if (request.robots.empty()) leaveOutHalves(*log);
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
        const bool otherCommands = hasWheelCommands(log) != hasWheelCommands(first);
        if (otherKind || otherCommands) return fail(log.source, "is of another kind of robot than " + first.source);
    }
    return {};
}

}  // namespace

Expected<std::vector<Log>> LearningLogs::learned() const {
    if (!holdOut.holdsAny()) return logs;
    std::vector<Log> parts;
    for (const Log& log : logs) {
        auto part = partOf(log, holdOut, LogPart::learned);
        if (!part) return tl::unexpected(part.error());
        parts.push_back(std::move(*part));
    }
    return parts;
}

Expected<LearningLogs> openLearningLogs(const LearningLogsRequest& request) {
    auto logs = openAll(request, {});
    if (!logs) return tl::unexpected(logs.error());
    for (const auto& check : {checkDifferent, checkSameKind})
        if (const auto fits = check(*logs); !fits) return tl::unexpected(fits.error());
    const auto holdOut = holdOutOf(*logs, request.holdOut, request.holdOutPart, request.holdOutBy);
    if (!holdOut) return tl::unexpected(holdOut.error());
    LearningLogs opened{std::move(*logs), {}, *holdOut};
    if (!hasWheelCommands(opened.logs.front())) return opened;
    const auto learned = opened.learned();
    if (!learned) return tl::unexpected(learned.error());
    const auto fit = fitDrive(steadyMotions(learned->front(), WheelSource::commands), learned->front().source);
    if (!fit) return tl::unexpected(fit.error());
    opened.drive = fit->drive;
    logs = openAll(request, fit->drive);
    if (!logs) return tl::unexpected(logs.error());
    opened.logs = std::move(*logs);
    return opened;
}

}  // namespace mrose::cli
