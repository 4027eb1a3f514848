#include "behaviour/wall_stroke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "behaviour/pushing_way.h"
#include "behaviour/steering.h"
#include "geometry/point.h"

namespace mrose {
namespace {

enum StrokePhase : std::int64_t { noStroke, goingRound, aligning, onTheSpot, backing, leading, turning, following };
constexpr std::array strokeNames{"no stroke",  "going round", "aligning", "turning to it",
                                 "backing up", "lunging",     "striking", "following"};

constexpr double goOn = 0.05;                                         // m, farther from the wall than where it begins
constexpr double elsewhere = 0.25, smoothed = 0.25;                   // m; share of a new sighting
constexpr double thin = 0.02;                                         // m, of what reaches a wall as the ball would
constexpr double rangeShare = 0.1;                                    // of the way to the ball: how far off that looks
constexpr double runUp = 0.4;                                         // m, of the straight way to where it stops
constexpr double cone = 0.8;                                          // aside for each metre of that way
constexpr double stepAround = 0.9;                                    // rad, on the way round the ball
constexpr double lookOut = 0.6, brakeGain = 1.2;                      // m, ahead for walls; 1/s
constexpr double leastAim = 0.1;                                      // m
constexpr double spareRoomBeside = 0.03;                              // m
constexpr double headingTolerance = 0.06;                             // rad
constexpr double spotGain = 2.5, arrivalGain = 1, leastSpeed = 0.03;  // 1/s; m/s
constexpr double stillThere = 1.7;                                    // tolerances, once it turns
constexpr double missedBy = 1, missedWithin = 0.25;                   // rad; m
constexpr double backShare = 0.5;                                     // of its speed
constexpr double approachFor = 15;                                    // s, at most
constexpr double backUp = 0.8;                                        // s
constexpr double spareTime = 1.3;                                     // of the time that a turn takes
constexpr double roomToTurn = 0.02;                                   // m, less than its reach is enough
constexpr double sameWall = 0.99;                                     // cosine between walls
constexpr double closerStep = 0.06;              // m: where there is no room, it stops so much nearer to the ball ...
constexpr int mostCloserSteps = 3;               // ... and again
constexpr double narrower = 0.7, strokeWay = 1;  // of the ball's radius; m, that a ball may go
constexpr double freeWeight = 3, closerCost = 0.15, wishWeight = 0.3, wayWeight = 0.3, stayBonus = 0.3;

Point turnedRight(const Point& p) { return {p.y, -p.x}; }

/// Along the wall, onwards.
Point alongWall(const WallStroke& stroke) { return stroke.side * turnedRight(stroke.away); }

/// m, from the ball's centre: a wall that it lies at.
double beginsWithin(const WallStroke::Situation& now, const WallStroke::Options& options) {
    return options.ballRadius + options.within + rangeShare * distance(position(now.robot), now.ball);
}

/// To turn, beside other walls than the ball's.
bool hasRoom(const WallStroke::Situation& now, const Point& there, const Point& away,
             const WallStroke::Options& options) {
    return std::ranges::none_of(now.walls.wallsNear(there, options.reach - roomToTurn),
                                [&](const FloorPlan::Wall& wall) { return dot(wall.away, away) < sameWall; });
}

/// The ball's place, where it can be: from afar it may look as if it lay in the wall or behind it.
Point thisSideOfWalls(const WallStroke::Situation& seen, double radius) {
    const Point from = position(seen.robot), way = seen.ball - from;
    const double far = length(way);
    const double free = far > 0 ? seen.walls.freeWay(from, (1 / far) * way, thin, far) : 0;
    const Point reached = free < far ? from + (free / far) * way : seen.ball;
    return clearOf(seen.walls.wallsNear(reached, radius), reached, radius);
}

}  // namespace

bool WallStroke::strikes() const { return phase >= leading; }
std::string_view WallStroke::doing() const { return strokeNames[static_cast<std::size_t>(phase)]; }

void WallStroke::begin(std::int64_t next, const Situation& now, double seconds) {
    phase = next;
    until = now.time + fromSeconds(seconds);
}

Pose WallStroke::stance(const Point& ball, const Options& options) const {
    const Point along = alongWall(*this);
    const Point at = ball - (options.stopDistance - closer) * along + (options.standOff - options.ballRadius) * away;
    return {at.x, at.y, wrapAngle(direction(along) - side * options.approach)};
}

/// Of the walls that the ball lies at and both sides, where there is room for the robot, nearer to the ball if need be:
/// the one from which the ball has the freest way and goes rather where it should.
bool WallStroke::choose(const Situation& now, const Options& options) {
    double best = 0;
    std::optional<WallStroke> chosen;
    const Point wanted = now.towards - now.ball;
    for (const FloorPlan::Wall& wall : now.walls.wallsNear(now.ball, beginsWithin(now, options)))
        for (const double turns : {1.0, -1.0})
            for (int steps = 0; steps <= mostCloserSteps; ++steps) {
                WallStroke candidate = *this;
                candidate.away = wall.away;
                candidate.side = turns;
                candidate.closer = closerStep * steps;
                const Point there = position(candidate.stance(now.ball, options));
                if (!hasRoom(now, there, wall.away, options)) continue;
                const Point onwards = 1 / std::numbers::sqrt2 * (alongWall(candidate) + wall.away);
                const double free = now.walls.freeWay(now.ball, onwards, narrower * options.ballRadius, strokeWay);
                const bool same = side == turns && dot(away, wall.away) > sameWall;
                const double score = freeWeight * free - candidate.closer / closerStep * closerCost +
                                     wishWeight * dot(onwards, wanted) / std::max(1e-9, length(wanted)) -
                                     wayWeight * distance(position(now.robot), there) + (same ? stayBonus : 0);
                if (!chosen || score > best) best = score, chosen = candidate;
            }
    if (chosen) *this = *chosen;
    return chosen.has_value();
}

std::optional<Command> WallStroke::update(const Situation& seen, const Options& options) {
    if (strikes()) return strike(seen, options);
    Situation now = seen;
    now.ball = thisSideOfWalls(seen, options.ballRadius);
    const bool moved = phase == noStroke || distance(now.ball, lies) > elsewhere;
    lies = moved ? now.ball : lies + smoothed * (now.ball - lies);
    now.ball = lies;
    const std::vector<FloorPlan::Wall> near = now.walls.wallsNear(now.ball, goOn + beginsWithin(now, options));
    if (near.empty()) {
        phase = noStroke;
        return std::nullopt;
    }
    if (phase == noStroke || now.time >= until) {
        if (phase != noStroke && phase != backing) side = -side;  // it took too long: rather from the other side
        begin(goingRound, now, approachFor);
    }
    if (phase == goingRound && !choose(now, options)) {
        phase = noStroke;
        return std::nullopt;
    }
    if (phase == backing) return Command{-backShare * options.speed, 0};
    return approach(now, options);
}

/// Straight to where it stops; there it turns on the spot, for which there is room.
std::optional<Command> WallStroke::align(const Pose& goal, const Situation& now, const Options& options) {
    const auto turnBy = [&](double angle) { return std::clamp(spotGain * angle, -options.rotation, options.rotation); };
    const Point way = position(goal) - position(now.robot);
    const double far = length(way);
    if (phase == onTheSpot ? far < stillThere * options.tolerance : far < options.tolerance) {
        phase = onTheSpot;
        const double left = wrapAngle(goal.heading - now.robot.heading);
        if (std::abs(left) > headingTolerance) return Command{0, turnBy(left)};
        heading = now.robot.heading;
        begin(leading, now, options.lead);
        return strike(now, options);
    }
    phase = aligning;
    const double off = wrapAngle(direction(way) - now.robot.heading);
    if (std::abs(off) > missedBy && far < missedWithin) return std::nullopt;
    const double ahead = std::max(0.0, Placement({0, 0, off}).cosine);
    return Command{std::min(options.speed, arrivalGain * far + leastSpeed) * ahead * ahead, turnBy(off)};
}

Command WallStroke::approach(const Situation& now, const Options& options) {
    const DriveLimits limits{options.speed, options.rotation};
    const Pose goal = stance(now.ball, options);
    const Placement frame(goal);
    const Point at = frame.placeBack(position(now.robot));
    const bool inCone = at.x < -options.tolerance && std::abs(at.y) < cone * -at.x + options.tolerance;
    if (phase == goingRound && (inCone || length(at) < options.tolerance)) phase = aligning;
    if (phase == aligning || phase == onTheSpot) {
        if (const auto command = align(goal, now, options)) return *command;
        begin(backing, now, backUp);
        return {-backShare * options.speed, 0};
    }
    // Round the ball to where the straight way begins.
    const Point along = alongWall(*this);
    const auto seenFromBall = [&](const Point& from) { return direction({dot(from, along), dot(from, away)}); };
    Point aim = frame.place({-runUp, 0});
    const double angle = seenFromBall(position(now.robot) - now.ball), wanted = seenFromBall(aim - now.ball);
    if (wanted - angle > stepAround) {
        const Placement round({0, 0, angle + stepAround});
        aim = now.ball + distance(aim, now.ball) * (round.cosine * along + round.sine * away);
    }
    aim = clearOf(now.walls.wallsNear(aim, options.reach + spareRoomBeside), aim, options.reach + spareRoomBeside);
    const Command command = driveTowards(Placement(now.robot).placeBack(aim), limits);
    const double free = now.walls.freeWay(position(now.robot), towards(now.robot.heading), options.reach, lookOut);
    return {std::min(command.v, brakeGain * std::min(free, distance(position(now.robot), aim) + leastAim)), command.w};
}

std::optional<Command> WallStroke::strike(const Situation& now, const Options& options) {
    const double turned = side * wrapAngle(now.robot.heading - heading);
    if (phase == leading && now.time >= until) begin(turning, now, spareTime * options.turn / options.strokeRotation);
    if (phase == turning && (turned >= options.turn || now.time >= until)) {
        ++strokes;
        begin(following, now, options.follow);
    }
    if (phase == leading) return Command{options.leadSpeed, 0};
    if (phase == turning) return Command{options.turnSpeed, side * options.strokeRotation};
    if (now.time < until) return Command{options.speed, 0};
    phase = noStroke;
    return std::nullopt;
}

}  // namespace mrose
