#include "planning/team_plan.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

constexpr std::array<std::string_view, 2> firstNames{"lowest", "highest"};
constexpr double leastWay = 1e-9;  // m

/// The place of a name in a list of names; nullopt: it is none of them.
template <std::size_t N>
std::optional<std::size_t> placeIn(const std::array<std::string_view, N>& names, std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

/// rad: of all turns on the spot, from the start's heading to the target's.
double turnsOf(const std::vector<Point>& points, const TeamMember& member) {
    double heading = member.start.heading, sum = 0;
    const auto turnTo = [&](double next) {
        sum += std::abs(wrapAngle(next - heading));
        heading = next;
    };
    for (std::size_t i = 1; i < points.size(); ++i)
        if (const Point line = points[i] - points[i - 1]; length(line) > leastWay) turnTo(direction(line));
    turnTo(member.target.heading);
    return sum;
}

}  // namespace

std::string nameOf(const TeamMethod& method) {
    return std::string(plannerNames[static_cast<std::size_t>(method.planner)]) + '+' +
           std::string(repairNames[static_cast<std::size_t>(method.repair)]) + '+' +
           std::string(firstNames[method.lowestFirst ? 0 : 1]);
}

std::optional<TeamMethod> teamMethod(std::string_view name) {
    const std::size_t one = name.find('+'), other = name.rfind('+');
    if (one == other) return std::nullopt;
    const auto planner = placeIn(plannerNames, name.substr(0, one));
    const auto repair = placeIn(repairNames, name.substr(one + 1, other - one - 1));
    const auto first = placeIn(firstNames, name.substr(other + 1));
    if (!planner || !repair || !first) return std::nullopt;
    return TeamMethod{static_cast<Planner>(*planner), static_cast<Repair>(*repair), *first == 0};
}

TeamPlan teamPlan(std::span<const TeamMember> team, const DiscSpace& space, const TeamMethod& method,
                  const DriveTimes& drive, double separation) {
    TeamPlan result;
    TeamEstimate& all = result.estimate;
    result.plans.resize(team.size());
    std::vector<TimedPath> others;
    const PathFinder finder(method.planner, space);
    for (std::size_t k = 0; k < team.size(); ++k) {
        const std::size_t i = method.lowestFirst ? k : team.size() - 1 - k;
        const TeamMember& member = team[i];
        DriveTimes own = drive;
        own.heading = member.start.heading;
        Plan& plan = result.plans[i];
        plan = repairedPlan(
            {finder, method.repair, position(member.start), position(member.target), own, others, separation});
        if (!plan.found()) {
            ++all.stuck;
            continue;
        }
        if (!plan.clear) ++all.unclear;
        const TimedPath path = plan.timed(own);
        for (const TimedPath& other : others) all.nearest = std::min(all.nearest, leastDistance(path, other));
        others.push_back(path);
        const double turns = turnsOf(plan.points, member), driven = lengthOf(plan.points);
        const double rests = drive.begin + plan.hold.duration + driven / drive.speed + turns / drive.rotation;
        all.rests = std::max(all.rests, rests);
        all.resting += rests;
        all.stops += plan.hold.duration;
        all.length += driven;
        all.turns += turns;
    }
    return result;
}

}  // namespace mrose
