#include <cstdio>

#include "common.h"
#include "io/format.h"
#include "report/program_json.h"
#include "workflow/inspect_log.h"

namespace mrose::cli {
namespace {

std::string rangeText(const MeasuredRange& range, int decimals) {
    return range.empty() ? "none" : fixed(range.least, decimals) + " to " + fixed(range.most, decimals);
}

std::string channelText(const ChannelDelay& c) {
    if (!c.identified) return "not identified: " + c.reason;
    return "dead time " + fixed(1000 * c.deadTime, 0) + " ± " + fixed(1000 * c.deadTimeError, 0) + " ms, lag " +
           fixed(1000 * c.lag, 0) + " ± " + fixed(1000 * c.lagError, 0) + " ms, jitter " + fixed(1000 * c.jitter, 0) +
           " ms (" + c.quality() + "; explains " + fixed(100 * c.explained, 1) + " % of the motion)";
}

void printRobot(const RobotInspection& robot) {
    std::printf("\nrobot %s%s\n", robot.robot.c_str(),
                robot.trajectories > 1 ? (", " + std::to_string(robot.trajectories) + " trajectories").c_str() : "");
    std::printf("  commands  %zu in %s s (%s Hz), v %s m/s, w %s rad/s\n", robot.commands,
                fixed(robot.commandTime, 1).c_str(), fixed(robot.commandRate(), 1).c_str(),
                rangeText(robot.v, 3).c_str(), rangeText(robot.w, 3).c_str());
    if (robot.poses == 0)
        std::puts("  poses     none: the log has no ground truth of it");
    else
        std::printf("  poses     %zu in %s s (%s Hz), x %s m, y %s m\n", robot.poses, fixed(robot.poseTime, 1).c_str(),
                    fixed(robot.poseRate(), 1).c_str(), rangeText(robot.x, 2).c_str(), rangeText(robot.y, 2).c_str());
    const LogDefects& d = robot.defects;
    for (const DefectCount& count : defectCounts()) {
        const std::int64_t found = d.*count.count;
        if (found == 0) continue;
        const double longest = count.count == &LogDefects::commandGaps ? d.longestCommandGap
                               : count.count == &LogDefects::poseGaps  ? d.longestPoseGap
                                                                       : 0;
        std::printf("  found     %lld %s%s%s\n", static_cast<long long>(found), found == 1 ? count.one : count.many,
                    count.done, longest > 0 ? (", the longest " + fixed(longest, 2) + " s").c_str() : "");
    }
    std::printf("  v         %s\n  w         %s\n", channelText(robot.delays.v).c_str(),
                channelText(robot.delays.w).c_str());
}

int runInspect(const InspectRequest& request, const CommonFlags& common) {
    const auto log = inspectLog(request);
    if (!log) return report(log.error());
    if (common.json) {
        std::puts(inspectionJson(*log).c_str());
        return success;
    }
    std::printf("%s: %s%s, %zu robot%s, %zu file%s\n", log->source.c_str(), log->format.c_str(),
                log->synthetic ? " (synthetic)" : "", log->robots.size(), log->robots.size() == 1 ? "" : "s",
                log->files.size(), log->files.size() == 1 ? "" : "s");
    for (const std::string& missing : log->incomplete) std::printf("Note: %s\n", missing.c_str());
    for (const RobotInspection& robot : log->robots) printRobot(robot);
    return success;
}

}  // namespace

Subcommand addInspect(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<InspectRequest>();
    CLI::App* sub = addSubcommand(app, common, "inspect",
                                  "Say what a log holds: robots, rates, gaps, ranges, dead times, and what was mended",
                                  "  mrose inspect MRCLAM_Dataset6\n"
                                  "  mrose inspect husky_windows.csv --json");
    addThreads(*sub, common);
    sub->add_option("LOG", request->log, "MRCLAM folder, Husky windows, CSV file or folder of CSV files")->required();
    sub->add_option("--robots", request->robots, "Only these robots, by name: 1,2")->delimiter(',');
    return {sub, [request, &common] { return runInspect(*request, common); }};
}

}  // namespace mrose::cli
