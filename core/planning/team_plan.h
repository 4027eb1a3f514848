#pragma once

#include "geometry/pose.h"
#include "planning/repairs.h"

namespace mrose {

/// A robot of a team: where it is and where it is to rest.
struct TeamMember {
    Pose start, target;
};

/// How a team plans: each robot by the same planner, and where its path conflicts with those of robots that go first,
/// by the same repair.
struct TeamMethod {
    Planner planner = Planner::visibilityGraph;
    Repair repair = Repair::wait;
    bool lowestFirst = true;  ///< robots of lower index go first, otherwise those of higher
};

/// What a team's plans come to, if all drive as they plan.
struct TeamPlan {
    std::vector<Plan> plans;  ///< of each member
    double rests = 0;         ///< s, when the last one does; of those that have a way
    std::size_t unclear = 0;  ///< plans that conflict still
    std::size_t stuck = 0;    ///< members without a way
};

/// Plans one member after the other. `drive` says how fast they are; their headings are their own. `separation`: m,
/// between their centres.
TeamPlan teamPlan(std::span<const TeamMember> team, const DiscSpace& space, const TeamMethod& method,
                  const DriveTimes& drive, double separation);

}  // namespace mrose
