#include "planning/timed_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/pose.h"

namespace mrose {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double leastLeg = 1e-9;  // m

/// Two places and the straight, even motion from one to the other, relative to another disc's.
struct RelativeMotion {
    double begin, end;  // s
    Point from, velocity;

    Point at(double time) const { return from + (time - begin) * velocity; }
    double closest() const {
        const double squared = dot(velocity, velocity);
        return squared > 0 ? begin - dot(from, velocity) / squared : begin;
    }
    /// When it is within a distance of the origin, cut to the motion's own time; begin > end: never.
    std::pair<double, double> within(double far) const {
        const double a = dot(velocity, velocity), b = dot(from, velocity), c = dot(from, from) - far * far;
        if (a == 0) return c < 0 ? std::pair{begin, end} : std::pair{endless, -endless};
        const double root = b * b - a * c;
        if (root <= 0) return {endless, -endless};
        const double half = std::sqrt(root);
        return {std::max(begin, begin + (-b - half) / a), std::min(end, begin + (-b + half) / a)};
    }
};

Point between(const TimedPath::Instant& from, const TimedPath::Instant& to, double time) {
    return from.place + ((time - from.time) / (to.time - from.time)) * (to.place - from.place);
}

/// Goes along a path in time.
class Walk {
public:
    explicit Walk(const TimedPath& path) : path_(path) {}

    double nextTime() const { return next_ < path_.instants.size() ? path_.instants[next_].time : endless; }
    void pass(double time) {
        while (nextTime() <= time) ++next_;
    }
    /// Not before what was passed, and not after what comes next.
    Point at(double time) const {
        if (next_ == 0) return path_.instants.front().place;
        const TimedPath::Instant& from = path_.instants[next_ - 1];
        if (next_ == path_.instants.size() || time <= from.time) return from.place;
        return between(from, path_.instants[next_], time);
    }

private:
    const TimedPath& path_;
    std::size_t next_ = 0;
};

/// The motion of one disc relative to another, piece by piece, until both have arrived, or `see` returns false.
template <class See>
void seeMotions(const TimedPath& mine, const TimedPath& other, const See& see) {
    Walk one(mine), two(other);
    double begin = std::min(one.nextTime(), two.nextTime());
    for (;;) {
        one.pass(begin);
        two.pass(begin);
        const double end = std::min(one.nextTime(), two.nextTime());
        if (end == endless) return;
        const Point from = one.at(begin) - two.at(begin), to = one.at(end) - two.at(end);
        if (!see(RelativeMotion{begin, end, from, (1 / (end - begin)) * (to - from)})) return;
        begin = end;
    }
}

}  // namespace

Point TimedPath::at(double time) const {
    if (time <= instants.front().time) return instants.front().place;
    if (time >= instants.back().time) return instants.back().place;
    const auto later = std::upper_bound(instants.begin(), instants.end(), time,
                                        [](double t, const Instant& instant) { return t < instant.time; });
    return between(*(later - 1), *later, time);
}

TimedPath timedPath(const std::vector<Point>& points, const DriveTimes& drive, const Hold& hold) {
    TimedPath path{{{points.front(), drive.begin}}};
    double time = drive.begin, heading = drive.heading, driven = 0;
    bool held = hold.duration <= 0;
    const auto stay = [&](double duration) {
        if (duration <= 0) return;
        time += duration;
        path.instants.push_back({path.instants.back().place, time});
    };
    const auto goTo = [&](const Point& place) {
        time += distance(path.instants.back().place, place) / drive.speed;
        path.instants.push_back({place, time});
    };
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Point line = points[i] - points[i - 1];
        const double far = length(line);
        if (far < leastLeg) continue;
        if (!held && hold.at <= driven) {
            stay(hold.duration);
            held = true;
        }
        const double along = direction(line);
        stay(std::abs(wrapAngle(along - heading)) / drive.rotation);
        heading = along;
        if (!held && hold.at < driven + far) {
            goTo(points[i - 1] + ((hold.at - driven) / far) * line);
            stay(hold.duration);
            held = true;
        }
        goTo(points[i]);
        driven += far;
    }
    return path;
}

std::optional<Conflict> firstConflict(const TimedPath& mine, const TimedPath& other, double separation) {
    std::optional<Conflict> conflict;
    bool over = false;
    seeMotions(mine, other, [&](const RelativeMotion& motion) {
        const auto [in, out] = motion.within(separation);
        if (!conflict && in < std::min(out, motion.closest()))
            conflict = Conflict{in, out, mine.at(in), other.at(in)};
        else if (conflict && in <= out)
            conflict->end = out;
        over = conflict && conflict->end < motion.end;
        return !over;
    });
    if (conflict && !over) conflict->end = endless;
    return conflict;
}

double leastDistance(const TimedPath& one, const TimedPath& other) {
    double least = distance(one.instants.front().place, other.instants.front().place);
    seeMotions(one, other, [&](const RelativeMotion& motion) {
        least = std::min({least, length(motion.at(std::clamp(motion.closest(), motion.begin, motion.end))),
                          length(motion.at(motion.end))});
        return true;
    });
    return least;
}

}  // namespace mrose
