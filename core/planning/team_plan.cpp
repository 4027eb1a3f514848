#include "planning/team_plan.h"

#include <algorithm>
#include <cmath>

namespace mrose {

TeamPlan teamPlan(std::span<const TeamMember> team, const DiscSpace& space, const TeamMethod& method,
                  const DriveTimes& drive, double separation) {
    TeamPlan result;
    result.plans.resize(team.size());
    std::vector<TimedPath> others;
    for (std::size_t k = 0; k < team.size(); ++k) {
        const std::size_t i = method.lowestFirst ? k : team.size() - 1 - k;
        const TeamMember& member = team[i];
        DriveTimes own = drive;
        own.heading = member.start.heading;
        Plan& plan = result.plans[i];
        plan = repairedPlan({method.planner, method.repair, space, position(member.start), position(member.target), own,
                             others, separation});
        if (!plan.found()) {
            ++result.stuck;
            continue;
        }
        if (!plan.clear) ++result.unclear;
        others.push_back(plan.timed(own));
        const Point last = plan.points.back() - plan.points[plan.points.size() - 2];
        const double turn = std::abs(wrapAngle(member.target.heading - direction(last)));
        result.rests = std::max(result.rests, others.back().arrival() + turn / drive.rotation);
    }
    return result;
}

}  // namespace mrose
