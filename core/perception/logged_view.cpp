#include "perception/logged_view.h"

#include <algorithm>
#include <cmath>

#include "geometry/angle.h"
#include "geometry/elementary.h"
#include "geometry/point.h"
#include "logs/log_lookup.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

/// What a body at `offset` hides of the state's subject.
void passBy(const Point& offset, double distance, double radius, const Point& subject, SensedState& state) {
    if (distance >= state.range || dot(offset, subject) <= 0) return;
    const double aside = std::abs(cross(offset, subject)) / state.range - radius;
    state.clearance = clearancePast(state.clearance, aside);
}

void countOthers(std::vector<LoggedSubject>& subjects, const View& view) {
    for (LoggedSubject& subject : subjects)
        for (const LoggedSubject& other : subjects)
            if (&other != &subject && view.holds(other.state.range, other.state.bearing))
                countOther(subject.state, other.state.range, other.state.bearing);
}

}  // namespace

LoggedView::LoggedView(const Log& log, const TrackedSizes& sizes) : log_(log), sizes_(sizes) {
    for (const LogSubject& subject : log.subjects) {
        const auto robot = std::find_if(log.robots.begin(), log.robots.end(), [&](const RobotLog& known) {
            return subject.kind == LogSubject::Kind::robot && known.robot == subject.robot;
        });
        robotOf_.push_back(robot == log.robots.end() ? std::optional<std::size_t>()
                                                     : static_cast<std::size_t>(robot - log.robots.begin()));
    }
}

bool LoggedView::known(std::size_t robot, std::size_t trajectory, Nanoseconds time) const {
    return truthIsKnown(log_.robots[robot].trajectories[trajectory].poses, time);
}

std::optional<Point> LoggedView::positionOf(const Trajectory& own, std::size_t subject, Nanoseconds time) const {
    if (log_.subjects[subject].kind == LogSubject::Kind::landmark) return log_.subjects[subject].position;
    if (!robotOf_[subject]) return std::nullopt;
    const Trajectory* const tracked = trajectoryBeside(own, log_.robots[*robotOf_[subject]]);
    if (tracked == nullptr || !truthIsKnown(tracked->poses, time)) return std::nullopt;
    return position(truthAt(tracked->poses, time));
}

Velocity LoggedView::velocityOf(std::size_t robot, std::size_t trajectory, Nanoseconds time) const {
    constexpr Nanoseconds apart = 100'000'000;
    const std::span<const StampedPose> poses = log_.robots[robot].trajectories[trajectory].poses;
    const Pose before = truthAt(poses, time - apart), after = truthAt(poses, time + apart);
    const double duration = toSeconds(2 * apart);
    const Point moved = position(after) - position(before);
    return {dot(moved, towards(truthAt(poses, time).heading)) / duration, (after.heading - before.heading) / duration};
}

double LoggedView::shareUnknown(std::size_t robot, const std::vector<Body>& bodies) const {
    double robots = 0, known = 0;
    for (std::size_t i = 0; i < log_.subjects.size(); ++i)
        robots += log_.subjects[i].kind == LogSubject::Kind::robot && robotOf_[i] != robot;
    for (const Body& body : bodies) known += body.robot;
    return robots > 0 ? 1 - known / robots : 0;
}

std::vector<LoggedView::Body> LoggedView::bodiesAt(std::size_t robot, const Trajectory& own, const Point& eye,
                                                   Nanoseconds time, const std::optional<Unknown>& unknown) const {
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < log_.subjects.size(); ++i) {
        if (robotOf_[i] == robot) continue;
        const bool isRobot = log_.subjects[i].kind == LogSubject::Kind::robot;
        if (isRobot && unknown && unknown->known != i) continue;
        const std::optional<Point> place = positionOf(own, i, time);
        if (!place) continue;
        const Point offset = *place - eye;
        bodies.push_back({i, offset, length(offset), isRobot ? sizes_.robot : sizes_.landmark, isRobot});
    }
    return bodies;
}

std::vector<LoggedSubject> LoggedView::at(std::size_t robot, std::size_t trajectory, Nanoseconds time, const View& view,
                                          const std::optional<Unknown>& unknown) const {
    const Trajectory& from = log_.robots[robot].trajectories[trajectory];
    SensedState own;
    own.own = truthAt(from.poses, time);
    own.velocity = velocityOf(robot, trajectory, time);
    std::vector<LoggedSubject> subjects;
    const std::vector<Body> bodies = bodiesAt(robot, from, position(own.own), time, unknown);
    own.unknownRobots = shareUnknown(robot, bodies);
    for (const Body& body : bodies) {
        SensedState state = own;
        state.subject = body.robot ? SubjectKind::robot : SubjectKind::landmark;
        state.range = body.distance;
        state.bearing = wrapAngleNearly(arcTangent(body.offset.y, body.offset.x) - own.own.heading);
        findEdges(state, view);
        for (const Body& other : bodies)
            if (&other != &body) passBy(other.offset, other.distance, other.radius, body.offset, state);
        subjects.push_back({body.subject, state});
    }
    countOthers(subjects, view);
    return subjects;
}

}  // namespace mrose
