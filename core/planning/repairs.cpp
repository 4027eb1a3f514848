#include "planning/repairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mrose {
namespace {

constexpr double holdStep = 0.2;       // m, between places where it may stop
constexpr int mostHolds = 16;          // of these
constexpr int mostDelays = 6;          // of which each lets one conflict pass
constexpr int halvings = 4;            // of the time that is too long
constexpr double afterwards = 0.2;     // s, that it stops longer
constexpr double longestHold = 30;     // s
constexpr int mostImagined = 4;        // conflicts
constexpr double imaginedApart = 0.4;  // m, between the discs of an imagined obstacle
constexpr int mostDiscs = 8;           // of these

/// About the least stop at one place of a path after which nothing conflicts; negative: none.
double leastHold(const PlanRequest& request, const std::vector<Point>& points, double at) {
    const auto conflictAfter = [&](double duration) {
        return firstConflict(timedPath(points, request.drive, {at, duration}), request.others, request.separation);
    };
    double tooShort = 0, duration = 0;
    std::optional<Conflict> conflict = conflictAfter(duration);
    if (!conflict) return 0;
    for (int i = 0; conflict; ++i) {
        if (i == mostDelays) return -1;
        tooShort = duration;
        duration += conflict->end - conflict->begin + afterwards;
        if (!(duration < longestHold)) return -1;
        conflict = conflictAfter(duration);
    }
    for (int i = 0; i < halvings; ++i) {
        const double middle = (tooShort + duration) / 2;
        (conflictAfter(middle) ? tooShort : duration) = middle;
    }
    return duration;
}

/// How far along its points a timed path is at a time.
double drivenAt(const TimedPath& path, double time) {
    double sum = 0;
    for (std::size_t i = 1; i < path.instants.size(); ++i) {
        const TimedPath::Instant &from = path.instants[i - 1], &to = path.instants[i];
        if (time < to.time) return sum + distance(from.place, path.at(time));
        sum += distance(from.place, to.place);
    }
    return sum;
}

void wait(const PlanRequest& request, const Conflict& conflict, Plan& plan) {
    const double until = drivenAt(plan.timed(request.drive), conflict.begin);
    double best = longestHold;
    for (int i = 0; i < mostHolds; ++i) {
        const double at = until - i * holdStep;
        const double duration = leastHold(request, plan.points, std::max(0.0, at));
        if (duration >= 0 && duration < best - afterwards) {
            best = duration;
            plan.hold = {std::max(0.0, at), duration};
            plan.clear = true;
        }
        if (at <= 0) break;
    }
}

std::vector<Point> plannedPoints(const PathFinder& finder, const Point& from, const Point& to) {
    const Path path = finder.path(from, to);
    if (!path.found()) return {};
    std::vector<Point> points = pointsOf(path);
    if (points.empty()) points = {from, to};
    return points;
}

/// Places round where it is at the conflict, and a little before, that are not passed near by the others.
std::vector<Point> temporaryTargets(const PlanRequest& request, const Conflict& conflict) {
    std::vector<std::pair<double, Point>> order;
    for (const double far : {0.75, 1.25})
        for (int k = 0; k < 8; ++k) {
            const Point place = conflict.mine + (far * request.separation) * towards(2 * std::numbers::pi * k / 8);
            if (!request.finder.space().free(place)) continue;
            double passed = std::numeric_limits<double>::infinity();
            for (const TimedPath& other : request.others)
                for (std::size_t i = 0; i < other.instants.size(); ++i)
                    passed = std::min(passed, distanceToSegment(place, other.instants[i > 0 ? i - 1 : 0].place,
                                                                other.instants[i].place));
            if (passed < request.separation) continue;
            order.emplace_back(distance(request.start, place) + distance(place, request.goal), place);
        }
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Point> places;
    for (std::size_t i = 0; i < std::min<std::size_t>(4, order.size()); ++i) places.push_back(order[i].second);
    return places;
}

void goAside(const PlanRequest& request, const Conflict& conflict, Plan& plan) {
    double soonest = std::numeric_limits<double>::infinity();
    for (const Point& place : temporaryTargets(request, conflict)) {
        std::vector<Point> points = plannedPoints(request.finder, request.start, place);
        const std::vector<Point> onwards = plannedPoints(request.finder, place, request.goal);
        if (points.empty() || onwards.empty()) continue;
        const double at = lengthOf(points);
        points.insert(points.end(), onwards.begin() + 1, onwards.end());
        const double duration = leastHold(request, points, at);
        if (duration < 0) continue;
        const double arrival = timedPath(points, request.drive, {at, duration}).arrival();
        if (arrival >= soonest) continue;
        soonest = arrival;
        plan.points = std::move(points);
        plan.hold = {at, duration};
        plan.clear = true;
    }
}

/// Where the other one is during a conflict, or only now.
std::vector<Point> placesOf(const TimedPath& other, const Conflict& conflict, bool now, double begin) {
    if (now) return {other.at(begin)};
    std::vector<Point> places{conflict.other};
    const double end = std::min(conflict.end, std::max(conflict.begin, other.arrival()));
    constexpr int steps = 40;
    for (int i = 1; i <= steps && places.size() < mostDiscs; ++i) {
        const Point place = other.at(conflict.begin + (end - conflict.begin) * i / steps);
        if (distance(place, places.back()) >= imaginedApart) places.push_back(place);
    }
    return places;
}

void goRound(const PlanRequest& request, Conflict conflict, std::size_t with, bool now, Plan& plan) {
    // Between its centre and theirs there is the separation: what is beyond its own radius is the obstacle's.
    const double radius = std::max(0.01, request.separation - request.finder.space().radius());
    std::vector<Point> discs;
    for (int i = 0; i < mostImagined; ++i) {
        const auto near = [](const Point& place) {
            return [&place](const Point& disc) { return distance(disc, place) < imaginedApart; };
        };
        for (const Point& place : placesOf(request.others[with], conflict, now, request.drive.begin))
            if (distance(place, request.start) > request.separation &&
                distance(place, request.goal) > request.separation && std::ranges::none_of(discs, near(place)))
                discs.push_back(place);
        if (discs.empty()) return;
        std::vector<ConvexPiece> pieces;
        for (const Point& disc : discs) pieces.push_back(ConvexPiece::circle(disc, radius));
        const PathFinder round(request.finder, pieces);
        std::vector<Point> points = plannedPoints(round, request.start, request.goal);
        if (points.empty()) return;
        plan.points = std::move(points);
        const auto again = firstConflict(plan.timed(request.drive), request.others, request.separation, &with);
        plan.clear = !again;
        if (!again || now) return;
        conflict = *again;
    }
}

}  // namespace

std::optional<Conflict> firstConflict(const TimedPath& mine, std::span<const TimedPath> others, double separation,
                                      std::size_t* with) {
    std::optional<Conflict> first;
    for (std::size_t i = 0; i < others.size(); ++i) {
        const auto conflict = firstConflict(mine, others[i], separation);
        if (!conflict || (first && first->begin <= conflict->begin)) continue;
        first = conflict;
        if (with != nullptr) *with = i;
    }
    return first;
}

Plan repairedPlan(const PlanRequest& request) {
    const Path path = request.finder.path(request.start, request.goal);
    Plan plan;
    plan.outcome = path.outcome;
    if (!path.found()) return plan;
    plan.points = pointsOf(path);
    if (plan.points.empty()) plan.points = {request.start, request.goal};
    std::size_t with = 0;
    const auto conflict = firstConflict(plan.timed(request.drive), request.others, request.separation, &with);
    if (!conflict) return plan;
    plan.clear = false;
    switch (request.repair) {
        case Repair::none:
            break;
        case Repair::wait:
            wait(request, *conflict, plan);
            break;
        case Repair::temporaryTarget:
            goAside(request, *conflict, plan);
            break;
        case Repair::imaginedObstacle:
            goRound(request, *conflict, with, false, plan);
            break;
        case Repair::replan:
            goRound(request, *conflict, with, true, plan);
            break;
    }
    return plan;
}

}  // namespace mrose
