#include "identification/motion_samples.h"

#include <algorithm>
#include <utility>

#include "identification/held_out_part.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

constexpr Nanoseconds leastGuard = nanosecondsPerSecond;
constexpr Nanoseconds shortTrajectory = 10 * nanosecondsPerSecond;

/// The usual margins would leave nothing of a short trajectory. Its history may be known before its truth begins.
GridMargins marginsOf(const Trajectory& trajectory, Nanoseconds memory) {
    GridMargins margins;
    margins.begin = std::max(margins.begin, memory);
    if (trajectory.poses.empty() || trajectory.commands.empty()) return margins;
    const Nanoseconds first = trajectory.poses.front().time;
    if (trajectory.poses.back().time - first >= shortTrajectory) return margins;
    const Nanoseconds known = std::max<Nanoseconds>(0, first - trajectory.commands.front().time);
    return {std::max<Nanoseconds>(0, margins.begin - known), 0};
}

/// A stretch of truth of a trajectory that another one continues.
struct Past {
    Nanoseconds end = 0;
    int fold = 0;
};

int foldOf(int group, const SampleOptions& options) {
    return ((options.heldOut.rankOfOther(group) % options.folds) + options.folds) % options.folds;
}

/// The patterns of one trajectory.
class TrajectoryReader {
public:
    TrajectoryReader(const Trajectory& trajectory, int robot, std::vector<Past> pasts, const InputReader& reader,
                     const SampleOptions& options, MotionSamples& out)
        : trajectory_(trajectory),
          robot_(robot),
          trajectoryFold_(mrose::foldOf(trajectory.group, options)),
          pasts_(std::move(pasts)),
          reader_(reader),
          options_(options),
          out_(out),
          fine_(poseGrid(trajectory, options.period / options.phases, marginsOf(trajectory, reader.lookBack()))),
          guard_(std::max(leastGuard, reader.lookBack() + options.period)) {}

    void read() {
        for (int phase = 0; phase < options_.phases; ++phase) readPhase(phase);
    }

private:
    std::size_t stride() const { return static_cast<std::size_t>(options_.phases); }
    bool known(std::size_t i) const { return i + stride() < fine_.size() && fine_.ok[i] && fine_.ok[i + stride()]; }

    int blockOf(Nanoseconds time) const { return static_cast<int>(toSeconds(time - fine_.start) / options_.block); }
    bool divided() const { return toSeconds(fine_.time(fine_.size()) - fine_.start) > 3 * options_.block; }
    int foldOf(Nanoseconds time) const {
        return divided() ? (blockOf(time) + robot_) % options_.folds : trajectoryFold_;
    }
    bool inGuard(Nanoseconds time) const {
        return divided() && blockOf(time) > 0 && blockOf(time - guard_) != blockOf(time);
    }

    void readPhase(int phase) {
        CommandHistory history;
        std::size_t issued = 0;
        SampleRun run{out_.samples.size(), 0, robot_, -1, phase};
        std::size_t reached = 0;
        const auto close = [&] {
            if (run.count > 0) out_.runs.push_back(run);
            run = {out_.samples.size(), 0, robot_, -1, phase};
            followed_ = {};
        };
        for (std::size_t i = static_cast<std::size_t>(phase); i < fine_.size(); i += stride()) {
            const Nanoseconds start = fine_.time(i);
            for (; issued < trajectory_.commands.size() && trajectory_.commands[issued].time <= start; ++issued)
                history.issue(trajectory_.commands[issued].time, trajectory_.commands[issued].command);
            if (!known(i) || inGuard(start)) {
                close();
                continue;
            }
            if (run.count > 0 && foldOf(start) != run.fold) close();
            run.fold = foldOf(start);
            // What is remembered of commands that lie in another fold is forgotten with them.
            const std::size_t before = std::exchange(reached, pastsReached(start, run.fold));
            if (reached < before) followed_ = {};
            add(history, i);
            ++run.count;
            markReaches(start, run);
        }
        close();
    }

    bool reaches(const Past& past, Nanoseconds start, int fold) const {
        return past.fold != fold && past.end > start - reader_.lookBack();
    }
    std::size_t pastsReached(Nanoseconds start, int fold) const {
        return static_cast<std::size_t>(
            std::ranges::count_if(pasts_, [&](const Past& past) { return reaches(past, start, fold); }));
    }

    void markReaches(Nanoseconds start, SampleRun& run) const {
        for (const Past& past : pasts_) {
            if (!reaches(past, start, run.fold)) continue;
            auto reach = std::find_if(run.reaches.begin(), run.reaches.end(),
                                      [&](const SampleRun::Reach& r) { return r.fold == past.fold; });
            if (reach == run.reaches.end()) reach = run.reaches.insert(reach, {past.fold, 0});
            reach->patterns = run.count;
        }
    }

    Velocity velocityAt(std::size_t i) const {
        return measuredVelocity(trajectory_, fine_.time(i)).value_or(fine_.velocities[i]);
    }

    void add(const CommandHistory& history, std::size_t i) {
        MotionSample sample{fine_.time(i),
                            relative(fine_.poses[i], fine_.poses[i + stride()]),
                            velocityAt(i),
                            velocityAt(i + stride()),
                            {},
                            {}};
        if (options_.measuredStarts) {
            const MeasuredStart measured = measuredStart(trajectory_, sample.start);
            sample.measured = relative(fine_.poses[i], measured.pose);
            sample.measuredVelocity = measured.velocity;
        }
        out_.samples.push_back(sample);
        out_.inputs.resize(out_.inputs.size() + out_.width);
        reader_.readRaw({&history, sample.start, sample.before}, robot_,
                        out_.inputs.data() + (out_.inputs.size() - out_.width), &followed_);
    }

    const Trajectory& trajectory_;
    int robot_, trajectoryFold_;
    std::vector<Past> pasts_;
    const InputReader& reader_;
    const SampleOptions& options_;
    MotionSamples& out_;
    PoseGrid fine_;
    Nanoseconds guard_;               ///< left out at the beginning of a block
    InputReader::Followed followed_;  ///< from pattern to pattern of a run; its first one tells it from older commands
};

/// What a trajectory's commands cover before its own truth: other trajectories of the robot.
std::vector<Past> pastsOf(const Trajectory& trajectory, const RobotLog& robot, const SampleOptions& options) {
    std::vector<Past> pasts;
    for (const Trajectory& other : robot.trajectories)
        if (continues(trajectory, other)) pasts.push_back({other.poses.back().time, foldOf(other.group, options)});
    return pasts;
}

}  // namespace

std::size_t SampleRun::firstLearned(int heldOut) const {
    if (fold == heldOut) return count;
    for (const Reach& reach : reaches)
        if (reach.fold == heldOut) return reach.patterns;
    return 0;
}

std::vector<TrackerOffset> removeTrackerOffsets(MotionSamples& samples) {
    std::vector<TrackerOffset> offsets(samples.robots.size());
    for (std::size_t robot = 0; robot < offsets.size(); ++robot) {
        const auto forOwn = [&](auto f) {
            for (const SampleRun& run : samples.runs)
                if (run.robot == static_cast<int>(robot))
                    for (std::size_t i = 0; i < run.count; ++i) f(samples.samples[run.first + i].increment);
        };
        TrackerEvidence evidence;
        forOwn([&](const Pose& d) { evidence.add(d); });
        offsets[robot] = evidence.offset();
        forOwn([&](Pose& d) { d.y -= offsets[robot].sideways(d); });
    }
    return offsets;
}

Expected<MotionSamples> motionSamples(std::span<const Log> logs, const MotionNetwork& network,
                                      const SampleOptions& options) {
    const InputReader reader(network);
    MotionSamples out;
    out.period = options.period;
    out.folds = options.folds;
    out.phases = options.phases;
    out.robots = network.robots;
    out.width = reader.width();
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories)
                TrajectoryReader(trajectory, reader.robotIndex(robot.robot), pastsOf(trajectory, robot, options),
                                 reader, options, out)
                    .read();
    if (out.samples.empty())
        return fail(logs.empty() ? "" : logs.front().source,
                    "has no stretch with commands and ground truth that is long enough to learn from");
    return out;
}

}  // namespace mrose
