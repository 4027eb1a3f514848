#include "identification/kick_samples.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "identification/ball_track.h"
#include "identification/robust_statistics.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

/// A kick in its trajectory, before all delays are known.
struct FoundKick {
    const Trajectory* trajectory;
    StampedKick kick;
    Point place;                    ///< where the ball lay
    std::optional<KickSample> hit;  ///< as it is if what moved the ball first was the kick
};

/// A robot that drives on may push the ball later: that was not the kick.
constexpr double surelyNoLonger = 0.05;  // s, or six standard deviations, after the usual delay

/// The mean of the positions within a span of time; nullopt of fewer than three.
std::optional<Point> meanPlace(const std::vector<StampedBall>& ball, Nanoseconds from, Nanoseconds to) {
    const auto first = std::ranges::lower_bound(ball, from, {}, &StampedBall::time);
    Point sum;
    double count = 0;
    for (auto at = first; at != ball.end() && at->time <= to; ++at) sum = sum + at->place, ++count;
    if (count < 3) return std::nullopt;
    return (1 / count) * sum;
}

class KickSearch {
public:
    KickSearch(const KickSampleOptions& options, KickSamples& to) : options_(options), to_(to) {}

    void add(const Trajectory& trajectory) {
        to_.commanded += trajectory.kicks.size();
        if (trajectory.kicks.empty()) return;
        const BallAnalysis track = analyseBallTrack(trajectory.ball);
        for (std::size_t i = 0; i < trajectory.kicks.size(); ++i) {
            const StampedKick& kick = trajectory.kicks[i];
            Nanoseconds until = kick.time + fromSeconds(options_.longestDelay);
            if (i + 1 < trajectory.kicks.size()) until = std::min(until, trajectory.kicks[i + 1].time);
            add(trajectory, kick, until, track);
        }
    }

    void finish() {
        std::vector<double> delays;
        for (const FoundKick& found : found_)
            if (found.hit) delays.push_back(found.hit->delay);
        const double usual = delays.empty() ? 0 : medianOf(delays);
        const double latest = usual + (delays.empty() ? 0 : std::max(surelyNoLonger, 6 * robustSpread(delays, usual)));
        KickNetwork::Range x{INFINITY, -INFINITY}, y = x;
        for (FoundKick& found : found_) {
            if (found.hit && found.hit->delay > latest) found.hit.reset();
            if (found.hit) widen(x, found.hit->state.ball_B.x), widen(y, found.hit->state.ball_B.y);
        }
        for (const FoundKick& found : found_)
            if (found.hit)
                to_.kicks.push_back(*found.hit);
            else
                addMiss(found, usual, latest, x, y);
    }

private:
    static void widen(KickNetwork::Range& range, double value) {
        range.least = std::min(range.least, value);
        range.most = std::max(range.most, value);
    }
    bool holds(const KickNetwork::Range& range, double value) const {
        return value >= range.least - options_.margin && value <= range.most + options_.margin;
    }

    /// Of a kick that was no hit: a miss if the ball still lies there at `latest`, s after the command.
    void addMiss(const FoundKick& found, double usual, double latest, const KickNetwork::Range& x,
                 const KickNetwork::Range& y) {
        constexpr Nanoseconds span = 60'000'000;
        const Nanoseconds then = found.kick.time + fromSeconds(latest);
        const auto later = meanPlace(found.trajectory->ball, then - span, then);
        const auto miss = sampleAt(found, found.kick.time + fromSeconds(usual));
        if (!later || !miss)
            ++to_.unseen;
        else if (distance(*later, found.place) > options_.still)
            ++to_.unclear;
        else if (!holds(x, miss->state.ball_B.x) || !holds(y, miss->state.ball_B.y))
            ++to_.far;
        else
            to_.kicks.push_back(*miss);
    }

    void add(const Trajectory& trajectory, const StampedKick& kick, Nanoseconds until, const BallAnalysis& track) {
        constexpr Nanoseconds before = 300'000'000;
        const auto place = meanPlace(trajectory.ball, kick.time - before, kick.time);
        const auto earlier = meanPlace(trajectory.ball, kick.time - 2 * before, kick.time - before);
        if (!place) return void(++to_.unseen);
        FoundKick found{&trajectory, kick, *place, std::nullopt};
        if (earlier && distance(*earlier, *place) > options_.still) return void(++to_.unclear);
        const auto left = std::ranges::find_if(track.events, [&](const BallEvent& event) {
            return event.rested && event.time >= kick.time && event.time < until;
        });
        if (left != track.events.end()) {
            found.hit = sampleAt(found, left->time);
            if (!found.hit) return void(++to_.unseen);
            const Pose pose = truthAt(trajectory.poses, left->time);
            found.hit->hit = true;
            found.hit->delay = toSeconds(left->time - kick.time);
            found.hit->speed = length(left->after);
            found.hit->direction = wrapAngle(direction(left->after) - pose.heading);
        }
        found_.push_back(found);
    }

    /// As it is if the kick acts then; nullopt where the robot is not tracked.
    static std::optional<KickSample> sampleAt(const FoundKick& found, Nanoseconds acts) {
        const auto& poses = found.trajectory->poses;
        if (poses.empty() || !truthIsKnown(poses, acts) || !truthIsKnown(poses, found.kick.time)) return std::nullopt;
        const auto now = velocityAt(poses, acts), then = velocityAt(poses, found.kick.time);
        if (!now || !then) return std::nullopt;
        KickSample sample;
        sample.state = {found.kick.power, *now, Placement(truthAt(poses, acts)).placeBack(found.place)};
        sample.atCommand = *then;
        return sample;
    }

    const KickSampleOptions& options_;
    KickSamples& to_;
    std::vector<FoundKick> found_;
};

}  // namespace

std::size_t KickSamples::hits() const {
    return static_cast<std::size_t>(std::ranges::count_if(kicks, [](const KickSample& kick) { return kick.hit; }));
}

KickSamples kickSamples(const std::vector<Log>& logs, const KickSampleOptions& options) {
    KickSamples samples;
    KickSearch search(options, samples);
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories) search.add(trajectory);
    search.finish();
    return samples;
}

}  // namespace mrose
