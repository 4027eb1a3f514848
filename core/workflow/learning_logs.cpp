#include "workflow/learning_logs.h"

#include <algorithm>

#include "identification/drive_fit.h"
#include "identification/held_out_part.h"
#include "logs/log_reader.h"
#include "logs/unit_doubts.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/resources.h"

namespace mrose {
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
        if (auto fits = checkMetres(*log); !fits) return tl::unexpected(fits.error());
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

/// What a robot file says, as it is given or among those that ship; nullopt where there is none.
Expected<std::optional<RobotKind>> kindOfFile(const std::string& name) {
    DiskDescriptions source = openDescriptions();
    for (const std::string& place : {name, joinedName(std::string(shippedPrefix) + "resources/robots/", name)}) {
        const auto text = source.text(place);
        if (!text) return tl::unexpected(text.error());
        if (!*text) continue;
        auto kind = parseRobotKind(**text, name, source.shown(place));
        if (kind && !*kind)
            return fail(source.shown(place), "has no section [kind], which says what is to be known of such robots");
        return kind;
    }
    return std::nullopt;
}

}  // namespace

Expected<RobotTraits> traitsOf(const std::string& kind, const Log& log) {
    const auto kinds = robotKinds();
    if (!kinds) return tl::unexpected(kinds.error());
    const RobotKind* const known = kind.empty() ? kindOfLog(*kinds, log) : kindNamed(*kinds, kind);
    if (known != nullptr) return known->traits;
    if (kind.empty()) return RobotTraits{"robot", {}, 0, false};
    const auto ofFile = kindOfFile(kind);
    if (!ofFile) return tl::unexpected(ofFile.error());
    if (*ofFile) return (*ofFile)->traits;
    std::string names;
    for (const RobotKind& shipped : *kinds) names += shipped.traits.type + ", ";
    return fail("", "is no kind of robot; expected " + names + "or a robot file", 0, "--type " + kind);
}

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

}  // namespace mrose
