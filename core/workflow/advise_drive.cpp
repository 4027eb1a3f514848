#include "workflow/advise_drive.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "io/file.h"
#include "io/format.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

template <class... Numbers>
std::string printed(const char* format, Numbers... numbers) {
    char text[200];
    std::snprintf(text, sizeof text, format, numbers...);
    return text;
}

CommandLimits limitsFor(const AdviseRequest& request, const CommandLimits& logs) {
    CommandLimits limits = logs;
    if (request.forward) limits.mostV = *request.forward;
    if (request.backward) limits.leastV = -*request.backward;
    if (request.turn) limits.mostW = *request.turn;
    return limits;
}

/// What a manoeuvre has that the logs lack, the plainest first.
std::string reasonFor(const AdvisedManoeuvre& advised, const CommandLimits& logs) {
    constexpr double more = 1.05, hardly = 0.02;
    const Command& to = advised.manoeuvre.to;
    if (std::abs(to.w) > more * logs.mostW + hardly)
        return printed("turns faster than the logs' %.2f rad/s", logs.mostW);
    if (to.v < more * logs.leastV - hardly)
        return logs.leastV < 0 ? printed("backward faster than the logs' %.2f m/s", -logs.leastV)
                               : std::string("backward, which the logs never are");
    if (to.v > more * logs.mostV + hardly) return printed("faster forward than the logs' %.2f m/s", logs.mostV);
    if (advised.manoeuvre.kind == DrivePiece::Kind::toAndFro) return "commands to and fro";
    if (advised.unfamiliar > 0.3) return "speeds, turns and changes that do not occur together in the logs";
    return "between what the logs have";
}

std::vector<AdviceReason> reasonsOf(const AdvisedDrive& drive, const CommandLimits& logs) {
    std::vector<AdviceReason> reasons;
    for (const AdvisedManoeuvre& advised : drive.manoeuvres) {
        const std::string what = reasonFor(advised, logs);
        auto reason =
            std::find_if(reasons.begin(), reasons.end(), [&](const AdviceReason& r) { return r.what == what; });
        if (reason == reasons.end()) reason = reasons.insert(reason, {what, 0, 0, 0});
        const double seconds = advised.manoeuvre.duration, all = reason->seconds + seconds;
        reason->unfamiliar += (advised.unfamiliar - reason->unfamiliar) * seconds / all;
        reason->doubt += (advised.doubt - reason->doubt) * seconds / all;
        reason->seconds = all;
    }
    std::stable_sort(reasons.begin(), reasons.end(),
                     [](const AdviceReason& a, const AdviceReason& b) { return a.seconds > b.seconds; });
    return reasons;
}

double restOf(const AdvisedDrive& drive) {
    double moving = 0;
    for (const AdvisedManoeuvre& advised : drive.manoeuvres) moving += advised.manoeuvre.duration;
    return drive.duration - moving;
}

std::string reasonText(const Advice& advice, const AdviceReason& reason) {
    std::string text = printed("%.1f s: ", reason.seconds) + reason.what;
    if (advice.drive.familiarKnown) text += printed("; %.0f %% of it unfamiliar", 100 * reason.unfamiliar);
    if (advice.drive.membersKnown)
        text += printed("; members disagree %.1f times as much as over the logs", reason.doubt);
    return text;
}

std::string commentsOf(const Advice& advice, const AdviseRequest& request) {
    std::string text = "# What to drive next, so that " + std::filesystem::path(request.network).filename().string() +
                       " learns most from it: mrose advise\n# Limits: " + limitsText(advice.limits) + "\n# Needs " +
                       spaceText(advice.drive) + "; it begins at rest, along x, and ends at rest.\n";
    for (const std::string& part : partTexts(advice)) text += "# " + part + '\n';
    return text;
}

std::string csvScript(const AdvisedDrive& drive) {
    std::string text = "t,v_cmd,w_cmd\n";
    for (const StampedCommand& issued : drive.commands)
        text +=
            secondsText(issued.time) + ',' + numberText(issued.command.v) + ',' + numberText(issued.command.w) + '\n';
    return text + secondsText(fromSeconds(drive.duration)) + ",0.0,0.0\n";
}

std::string tomlScript(const AdvisedDrive& drive) {
    std::string text =
        "# In a scenario: a line of a [[robot]], in place of its controller.\ncontroller = { kind = "
        "\"velocity_script\", commands = [\n";
    for (const StampedCommand& issued : drive.commands)
        text += "    { t_s = " + secondsText(issued.time) + ", v_mps = " + numberText(issued.command.v) +
                ", w_degps = " + numberText(180 / std::numbers::pi * issued.command.w) + " },\n";
    return text + "] }\n";
}

/// s from the first to the last tracked pose of each trajectory.
double trackedSeconds(std::span<const Log> logs) {
    double sum = 0;
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories)
                if (!trajectory.poses.empty())
                    sum += toSeconds(trajectory.poses.back().time - trajectory.poses.front().time);
    return sum;
}

std::vector<std::string> noticesOf(const Advice& advice, const LearnedMotion& motion, std::span<const Log> logs) {
    constexpr double fewSeconds = 60;
    std::vector<std::string> notices;
    for (const Log& log : logs)
        for (std::string& notice : otherRobotNotices(motion.network(), log))
            if (std::find(notices.begin(), notices.end(), notice) == notices.end())
                notices.push_back(std::move(notice));
    if (const double seconds = trackedSeconds(logs); seconds < fewSeconds)
        notices.push_back(printed("the logs hold %.1f s of driving: they hardly show what the robot can do", seconds));
    if (motion.memberCount() < 2)
        notices.push_back(
            "the network is a single one, which does not say where it doubts: only what the logs lack counts");
    if (motion.familiar() == nullptr)
        notices.push_back(
            "the network's file does not say what driving it was learned from ([motion.familiar]); one that mrose "
            "train "
            "makes anew does");
    if (motion.network().synthetic) notices.push_back("the network was learned from synthetic logs");
    if (advice.limits == advice.logs)
        notices.push_back("limits are those of the logs; --forward, --backward and --turn give the robot's own");
    return notices;
}

bool endsIn(const std::string& name, const char* extension) {
    return std::filesystem::path(name).extension() == extension;
}

Expected<void> checkAdviceOutput(const AdviseRequest& request) {
    if (request.output.empty()) return {};
    if (!endsIn(request.output, ".csv") && !endsIn(request.output, ".toml"))
        return fail(request.output, "expected a name that ends in .csv or .toml");
    std::vector<std::string> read{request.network};
    for (const std::string& log : request.logs) read.push_back(placeOfLog(log));
    return checkOutput(request.output, read, request.overwrite);
}

}  // namespace

std::string limitsText(const CommandLimits& limits) {
    std::string text = printed("forward up to %.2f m/s", limits.mostV);
    if (limits.leastV < 0) text += printed(", backward up to %.2f m/s", -limits.leastV);
    return text + printed(", turning up to %.2f rad/s either way", limits.mostW);
}

std::vector<std::string> partTexts(const Advice& advice) {
    std::vector<std::string> texts;
    for (const AdviceReason& reason : advice.reasons) texts.push_back(reasonText(advice, reason));
    texts.push_back(printed("%.1f s: rest, before and after", advice.rest));
    return texts;
}

std::string spaceText(const AdvisedDrive& drive) {
    return printed("%.1f x %.1f m round the robot's reference point, by the network's own rollout",
                   drive.most.x - drive.least.x, drive.most.y - drive.least.y);
}

Expected<Advice> advise(const AdviseRequest& request, const Progress& progress) {
    if (auto can = checkAdviceOutput(request); !can) return tl::unexpected(can.error());
    const auto motion = openNetwork(request.network);
    if (!motion) return tl::unexpected(motion.error());
    std::vector<Log> logs;
    for (const std::string& source : request.logs) {
        auto log = openLog(source, request.robots, (*motion)->network().drive);
        if (!log) return tl::unexpected(log.error());
        logs.push_back(std::move(*log));
    }
    Advice advice;
    advice.logs = limitsOf(logs);
    advice.limits = limitsFor(request, advice.logs);
    AdviceOptions options;
    options.limits = advice.limits;
    options.duration = request.duration;
    options.radius = request.radius;
    options.seed = request.seed;
    auto drive = adviseDrive(**motion, logs, options, progress);
    if (!drive) {
        Error error = drive.error();
        if (error.file.empty() && error.key.empty()) error.file = request.logs.front();
        return tl::unexpected(std::move(error));
    }
    advice.drive = std::move(*drive);
    advice.reasons = reasonsOf(advice.drive, advice.logs);
    advice.rest = restOf(advice.drive);
    advice.notices = noticesOf(advice, **motion, logs);
    advice.script = commentsOf(advice, request) +
                    (endsIn(request.output, ".toml") ? tomlScript(advice.drive) : csvScript(advice.drive));
    if (!request.output.empty())
        if (auto written = writeFileAtomically(request.output, advice.script); !written)
            return tl::unexpected(written.error());
    return advice;
}

}  // namespace mrose
