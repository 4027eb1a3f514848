#include "identification/advised_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/point.h"
#include "identification/familiar_driving.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

using Driving = FamiliarDriving::Driving;

constexpr double restAtStart = 0.5, restAtEnd = 2;      // s
constexpr int sampledDrives = 60, sampledSeconds = 10;  // of driving within the limits

double squaredWay(const Driving& a, const Driving& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/// Driving within the limits, each sample with how far the nearest known driving is and what it is worth.
class Samples {
public:
    void add(const Driving& driving, double worth) {
        all_.push_back(driving);
        worth_.push_back(worth);
        nearest_.push_back(std::numeric_limits<double>::infinity());
    }
    void know(const Driving& driving) {
        for (std::size_t s = 0; s < all_.size(); ++s) nearest_[s] = std::min(nearest_[s], squaredWay(all_[s], driving));
    }
    /// By how much the sum of squared distances falls, each times its worth, if this were known too.
    double gain(const std::vector<Driving>& drivings) const {
        double sum = 0;
        for (std::size_t s = 0; s < all_.size(); ++s) {
            double nearest = nearest_[s];
            for (const Driving& driving : drivings) nearest = std::min(nearest, squaredWay(all_[s], driving));
            sum += worth_[s] * (nearest_[s] - nearest);
        }
        return sum;
    }
    double meanDistance() const {
        double sum = 0;
        for (const double nearest : nearest_) sum += std::sqrt(nearest);
        return sum / double(nearest_.size());
    }

private:
    std::vector<Driving> all_;
    std::vector<double> worth_, nearest_;  ///< nearest: squared
};

/// What a manoeuvre would come to.
struct Tried {
    DrivePiece manoeuvre;
    PlannedDrive after;
    std::vector<Driving> drivings;
    double gain = -1;  ///< per second; below 0: it leaves the area
};

class Adviser {
public:
    Adviser(const LearnedMotion& motion, const AdviceOptions& options, FamiliarDriving channels)
        : motion_(motion), options_(options), reader_(motion.network().form, std::move(channels)), drive_(motion) {}

    void sampleDriving() {
        for (int d = 0; d < sampledDrives; ++d) {
            PlannedDrive drive(motion_);
            for (int m = 0; drive.seconds() < sampledSeconds; ++m) {
                const auto manoeuvre =
                    drawnManoeuvre(options_.limits, drive.command(), options_.seed, 1000 * (d + 1) + m);
                drive.drive(manoeuvre, [&](const PlannedDrive::Period& period) {
                    if (count_++ % 3 != 0) return;
                    // A network of one member doubts everything alike.
                    const double worth = motion_.memberCount() > 1 ? disagreement(motion_, period.input()) : 1;
                    samples_.add(reader_.driving(period.input()), worth);
                });
            }
        }
    }

    void know(std::span<const Driving> logs) {
        for (const Driving& driving : logs) samples_.know(driving);
        advised_.farBefore = samples_.meanDistance();
    }

    Expected<AdvisedDrive> advise(double usual, const Progress& progress) {
        usual_ = usual;
        advised_.membersKnown = motion_.memberCount() > 1 && usual > 0;
        advised_.familiarKnown = motion_.familiar() != nullptr;
        take(tried({DrivePiece::Kind::hold, restAtStart, {}, {}, 0}));
        while (drive_.seconds() < options_.duration - restAtEnd - 0.35) {
            if (!mayGoOn(progress, drive_.seconds() / options_.duration)) return fail("", "cancelled");
            take(best());
        }
        take(tried({DrivePiece::Kind::hold, options_.duration - drive_.seconds(), {}, {}, 0}));
        advised_.manoeuvres.pop_back();
        advised_.manoeuvres.erase(advised_.manoeuvres.begin());
        advised_.duration = options_.duration;
        advised_.farAfter = samples_.meanDistance();
        return std::move(advised_);
    }

private:
    Tried tried(const DrivePiece& manoeuvre) const {
        Tried result{manoeuvre, drive_, {}, -1};
        result.after.drive(manoeuvre, [&](const PlannedDrive::Period& period) {
            result.drivings.push_back(reader_.driving(period.input()));
        });
        return result;
    }

    /// Where the robot comes to stand if it is stopped then.
    Pose stoppedAfter(const Tried& tried) const {
        PlannedDrive stopping = tried.after;
        stopping.drive({DrivePiece::Kind::hold, 1.0, {}, {}, 0}, [](const PlannedDrive::Period&) {});
        return stopping.pose();
    }

    Tried best() {
        const double left = options_.duration - restAtEnd - drive_.seconds();
        Tried best = tried(homewards(left));
        for (int c = 0; c < options_.candidates; ++c) {
            DrivePiece manoeuvre = drawnManoeuvre(options_.limits, drive_.command(), options_.seed + 1, number_++);
            manoeuvre.duration = std::min(manoeuvre.duration, left);
            Tried next = tried(manoeuvre);
            if (length(position(stoppedAfter(next))) > options_.radius) continue;
            next.gain = samples_.gain(next.drivings) / manoeuvre.duration;
            if (next.gain > best.gain) best = std::move(next);
        }
        return best;
    }

    /// Turns towards where it began, then goes there.
    DrivePiece homewards(double left) const {
        const CommandLimits& limits = options_.limits;
        const double away = wrapAngle(direction(Point{} - position(drive_.pose())) - drive_.pose().heading);
        const double turn = std::min(limits.mostW, 1.0);
        if (std::abs(away) > 0.4 && turn > 0)
            return {DrivePiece::Kind::hold,
                    std::min(left, std::max(0.4, std::abs(away) / turn)),
                    {0, away > 0 ? turn : -turn},
                    {},
                    0};
        return {DrivePiece::Kind::hold, std::min(left, 1.0), {limits.mostV / 2, 0}, {}, 0};
    }

    void take(const Tried& chosen) {
        AdvisedManoeuvre& advised = advised_.manoeuvres.emplace_back();
        advised.manoeuvre = chosen.manoeuvre;
        double periods = 0;
        drive_.drive(chosen.manoeuvre, [&](const PlannedDrive::Period& period) {
            const Command command = period.commands.at(period.start);
            if (advised_.commands.empty() || !(advised_.commands.back().command == command))
                advised_.commands.push_back({period.start, command});
            ++periods;
            advised.doubt += usual_ > 0 ? disagreement(motion_, period.input()) / usual_ : 0;
            if (motion_.familiar() != nullptr) advised.unfamiliar += motion_.familiar()->isUnfamiliar(period.input());
            grow();
        });
        grow();
        advised.doubt /= std::max(1.0, periods);
        advised.unfamiliar /= std::max(1.0, periods);
        for (const Driving& driving : chosen.drivings) samples_.know(driving);
    }

    void grow() {
        const Pose& pose = drive_.pose();
        advised_.least = {std::min(advised_.least.x, pose.x), std::min(advised_.least.y, pose.y), 0};
        advised_.most = {std::max(advised_.most.x, pose.x), std::max(advised_.most.y, pose.y), 0};
    }

    const LearnedMotion& motion_;
    const AdviceOptions& options_;
    DrivingReader reader_;
    PlannedDrive drive_;
    Samples samples_;
    AdvisedDrive advised_;
    std::int64_t number_ = 0, count_ = 0;
    double usual_ = 0;  ///< disagreement over the logs
};

/// The logs' driving.
Expected<std::vector<Driving>> drivingOf(std::span<const Log> logs, const MotionNetwork& network,
                                         const DrivingReader& reader) {
    MotionNetwork raw = reader.raw();
    raw.robots = network.robots;
    SampleOptions once;
    once.period = network.period;
    once.phases = once.folds = 1;
    const auto samples = motionSamples(logs, raw, once);
    if (!samples) return tl::unexpected(samples.error());
    std::vector<Driving> drivings;
    for (std::size_t s = 0; s < samples->samples.size(); ++s) drivings.push_back(reader.driving(samples->inputsOf(s)));
    return drivings;
}

/// Mean disagreement over the logs, of one period in ten; 0 where it is not known, as of windows of a few seconds.
double usualDisagreement(std::span<const Log> logs, const LearnedMotion& motion) {
    double sum = 0, count = 0;
    GridMargins margins;
    margins.begin = std::max(margins.begin, motion.inputs().lookBack());
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories) {
                const PoseGrid grid = poseGrid(trajectory, 10 * motion.network().period, margins);
                CommandHistory history;
                auto next = trajectory.commands.begin();
                for (std::size_t i = 0; i < grid.size(); ++i) {
                    for (; next != trajectory.commands.end() && next->time <= grid.time(i); ++next)
                        history.issue(next->time, next->command);
                    if (!grid.ok[i]) continue;
                    const Velocity velocity = measuredVelocity(trajectory, grid.time(i)).value_or(grid.velocities[i]);
                    sum += disagreement(motion, {&history, grid.time(i), velocity, {}, {}});
                    ++count;
                }
            }
    return count > 0 ? sum / count : 0;
}

/// The driving that a network says that it learned from, in units of `channels`.
std::vector<Driving> drivingLearnedFrom(const MotionNetwork& network, const FamiliarDriving& channels) {
    std::vector<Driving> drivings;
    if (!network.familiar) return drivings;
    const double v = network.familiar->v.scale / channels.v.scale, w = network.familiar->w.scale / channels.w.scale;
    for (Driving driving : network.familiar->prototypes) {
        for (std::size_t i = 0; i < driving.size(); ++i) driving[i] *= i % 2 == 0 ? v : w;
        drivings.push_back(driving);
    }
    return drivings;
}

/// Scales are standard deviations of what is spread evenly over the limits.
FamiliarDriving channelsWithin(const CommandLimits& limits, const MotionNetwork& network) {
    FamiliarDriving channels = describedChannels(network);
    const auto deviation = [](double range) { return std::max(range, 1e-3) / std::sqrt(12.0); };
    channels.v.scale = deviation(limits.mostV - limits.leastV);
    channels.w.scale = deviation(2 * limits.mostW);
    return channels;
}

}  // namespace

Expected<AdvisedDrive> adviseDrive(const LearnedMotion& motion, std::span<const Log> logs, const AdviceOptions& options,
                                   const Progress& progress) {
    const CommandLimits& limits = options.limits;
    if (limits.leastV >= 0 && limits.mostV <= 0 && limits.mostW <= 0)
        return fail("", "allow no motion; expected logs whose commands move the robot, or wider limits", 0, "limits");
    const FamiliarDriving channels = channelsWithin(options.limits, motion.network());
    const DrivingReader reader(motion.network().form, channels);
    const auto known = drivingOf(logs, motion.network(), reader);
    if (!known) return tl::unexpected(known.error());
    Adviser adviser(motion, options, channels);
    adviser.sampleDriving();
    adviser.know(*known);
    adviser.know(drivingLearnedFrom(motion.network(), channels));
    return adviser.advise(usualDisagreement(logs, motion), progress);
}

CommandLimits limitsOf(std::span<const Log> logs) {
    CommandLimits limits;
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories)
                for (const StampedCommand& issued : trajectory.commands) {
                    limits.leastV = std::min(limits.leastV, issued.command.v);
                    limits.mostV = std::max(limits.mostV, issued.command.v);
                    limits.mostW = std::max(limits.mostW, std::abs(issued.command.w));
                }
    return limits;
}

}  // namespace mrose
