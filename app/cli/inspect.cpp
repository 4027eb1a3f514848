#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common.h"
#include "identification/dead_time.h"
#include "io/format.h"

namespace mrose::cli {
namespace {

struct Range {
    double least = INFINITY, most = -INFINITY;
    void add(double x) {
        least = std::min(least, x);
        most = std::max(most, x);
    }
    std::string text(int decimals) const {
        return std::isfinite(least) ? fixed(least, decimals) + " to " + fixed(most, decimals) : "none";
    }
    nlohmann::json json() const { return std::isfinite(least) ? nlohmann::json{least, most} : nlohmann::json(nullptr); }
};

/// What a robot's log holds, in figures.
struct RobotFacts {
    std::size_t trajectories = 0, commands = 0, poses = 0;
    double commandTime = 0, poseTime = 0;  ///< s, from first to last, summed over trajectories
    Range v, w, x, y;

    explicit RobotFacts(const RobotLog& robot) : trajectories(robot.trajectories.size()) {
        for (const Trajectory& t : robot.trajectories) {
            commands += t.commands.size();
            poses += t.poses.size();
            if (!t.commands.empty()) commandTime += toSeconds(t.commands.back().time - t.commands.front().time);
            if (!t.poses.empty()) poseTime += toSeconds(t.poses.back().time - t.poses.front().time);
            for (const StampedCommand& c : t.commands) {
                v.add(c.command.v);
                w.add(c.command.w);
            }
            for (const StampedPose& p : t.poses) {
                x.add(p.pose.x);
                y.add(p.pose.y);
            }
        }
    }
    double commandRate() const {
        return commandTime > 0 ? static_cast<double>(commands - trajectories) / commandTime : 0;
    }
    double poseRate() const { return poseTime > 0 ? static_cast<double>(poses - trajectories) / poseTime : 0; }
};

struct Count {
    std::int64_t LogDefects::*member;
    const char *key, *one, *many, *done;
};
const Count counts[] = {{&LogDefects::outOfOrder, "out_of_order", "stamp", "stamps", " out of order, sorted"},
                        {&LogDefects::duplicates, "duplicates", "equal stamp", "equal stamps", ", last kept"},
                        {&LogDefects::blips, "blips", "blip", "blips", " (single zero commands), dropped"},
                        {&LogDefects::poseOutliers, "pose_outliers", "pose outlier", "pose outliers", ", dropped"},
                        {&LogDefects::unpaired, "unpaired", "value", "values", " without a partner, dropped"},
                        {&LogDefects::headingWraps, "heading_wraps", "heading wrap", "heading wraps", ", unwrapped"},
                        {&LogDefects::cutLines, "cut_lines", "last line", "last lines", " cut off, left out"},
                        {&LogDefects::commandGaps, "command_gaps", "gap", "gaps", " in the commands"},
                        {&LogDefects::poseGaps, "pose_gaps", "gap", "gaps", " in the poses"}};

std::string channelText(const ChannelDelay& c) {
    if (!c.identified) return "not identified: " + c.reason;
    return "dead time " + fixed(1000 * c.deadTime, 0) + " ± " + fixed(1000 * c.deadTimeError, 0) + " ms, lag " +
           fixed(1000 * c.lag, 0) + " ± " + fixed(1000 * c.lagError, 0) + " ms, jitter " + fixed(1000 * c.jitter, 0) +
           " ms (" + c.quality() + "; explains " + fixed(100 * c.explained, 1) + " % of the motion)";
}

nlohmann::json channelJson(const ChannelDelay& c) {
    if (!c.identified) return {{"identified", false}, {"reason", c.reason}};
    return {{"identified", true},
            {"dead_time_s", c.deadTime},
            {"dead_time_error_s", c.deadTimeError},
            {"lag_s", c.lag},
            {"lag_error_s", c.lagError},
            {"jitter_s", c.jitter},
            {"jitter_error_s", c.jitterError},
            {"explained", c.explained},
            {"quality", c.quality()}};
}

nlohmann::json robotJson(const RobotLog& robot, const DeadTimes& delays) {
    const RobotFacts f(robot);
    nlohmann::json defects;
    for (const Count& count : counts) defects[count.key] = robot.defects.*count.member;
    defects["longest_command_gap_s"] = robot.defects.longestCommandGap;
    defects["longest_pose_gap_s"] = robot.defects.longestPoseGap;
    return {{"robot", robot.robot},
            {"trajectories", f.trajectories},
            {"commands",
             {{"count", f.commands},
              {"seconds", f.commandTime},
              {"rate_hz", f.commandRate()},
              {"v_mps", f.v.json()},
              {"w_radps", f.w.json()}}},
            {"poses",
             {{"count", f.poses},
              {"seconds", f.poseTime},
              {"rate_hz", f.poseRate()},
              {"x_m", f.x.json()},
              {"y_m", f.y.json()}}},
            {"defects", defects},
            {"delays", {{"v", channelJson(delays.v)}, {"w", channelJson(delays.w)}}}};
}

void printRobot(const RobotLog& robot, const DeadTimes& delays) {
    const RobotFacts f(robot);
    std::printf("\nrobot %s%s\n", robot.robot.c_str(),
                f.trajectories > 1 ? (", " + std::to_string(f.trajectories) + " trajectories").c_str() : "");
    std::printf("  commands  %zu in %s s (%s Hz), v %s m/s, w %s rad/s\n", f.commands, fixed(f.commandTime, 1).c_str(),
                fixed(f.commandRate(), 1).c_str(), f.v.text(3).c_str(), f.w.text(3).c_str());
    if (f.poses == 0)
        std::puts("  poses     none: the log has no ground truth of it");
    else
        std::printf("  poses     %zu in %s s (%s Hz), x %s m, y %s m\n", f.poses, fixed(f.poseTime, 1).c_str(),
                    fixed(f.poseRate(), 1).c_str(), f.x.text(2).c_str(), f.y.text(2).c_str());
    const LogDefects& d = robot.defects;
    for (const Count& count : counts) {
        const std::int64_t found = d.*count.member;
        if (found == 0) continue;
        const double longest = count.member == &LogDefects::commandGaps ? d.longestCommandGap
                               : count.member == &LogDefects::poseGaps  ? d.longestPoseGap
                                                                        : 0;
        std::printf("  found     %lld %s%s%s\n", static_cast<long long>(found), found == 1 ? count.one : count.many,
                    count.done, longest > 0 ? (", the longest " + fixed(longest, 2) + " s").c_str() : "");
    }
    std::printf("  v         %s\n  w         %s\n", channelText(delays.v).c_str(), channelText(delays.w).c_str());
}

int inspect(const std::string& source, const std::vector<std::string>& robots, const CommonFlags& common) {
    const auto log = openLog(source, robots);
    if (!log) return report(log.error());
    const std::vector<DeadTimes> delays = identifyEachDeadTime(*log);
    if (common.json) {
        nlohmann::json json{{"source", log->source},
                            {"format", log->format},
                            {"synthetic", log->synthetic},
                            {"incomplete", log->incomplete}};
        for (const LogFile& file : log->files) json["files"].push_back({{"path", file.path}, {"xxh3", file.hash}});
        for (std::size_t i = 0; i < delays.size(); ++i) json["robots"].push_back(robotJson(log->robots[i], delays[i]));
        std::puts(json.dump(2).c_str());
        return success;
    }
    std::printf("%s: %s%s, %zu robot%s, %zu file%s\n", log->source.c_str(), log->format.c_str(),
                log->synthetic ? " (synthetic)" : "", log->robots.size(), log->robots.size() == 1 ? "" : "s",
                log->files.size(), log->files.size() == 1 ? "" : "s");
    for (const std::string& missing : log->incomplete) std::printf("Note: %s\n", missing.c_str());
    for (std::size_t i = 0; i < delays.size(); ++i) printRobot(log->robots[i], delays[i]);
    return success;
}

}  // namespace

Subcommand addInspect(CLI::App& app, CommonFlags& common) {
    struct Flags {
        std::string log;
        std::vector<std::string> robots;
    };
    auto flags = std::make_shared<Flags>();
    CLI::App* sub = addSubcommand(app, common, "inspect",
                                  "Say what a log holds: robots, rates, gaps, ranges, dead times, and what was mended",
                                  "  mrose inspect MRCLAM_Dataset6\n"
                                  "  mrose inspect husky_windows.csv --json");
    addThreads(*sub, common);
    sub->add_option("LOG", flags->log, "MRCLAM folder, Husky windows, CSV file or folder of CSV files")->required();
    sub->add_option("--robots", flags->robots, "Only these robots, by name: 1,2")->delimiter(',');
    return {sub, [flags, &common] { return inspect(flags->log, flags->robots, common); }};
}

}  // namespace mrose::cli
