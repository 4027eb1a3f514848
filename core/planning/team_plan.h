#pragma once

#include <optional>
#include <string>
#include <string_view>

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
    bool operator==(const TeamMethod&) const = default;
};

/// "visibility_graph+wait+lowest"
std::string nameOf(const TeamMethod& method);
/// nullopt: no method has that name.
std::optional<TeamMethod> teamMethod(std::string_view name);

/// What a team's plans come to, if all drive as they plan; of those that have a way.
struct TeamEstimate {
    double rests = 0;        ///< s, when the last one does
    double resting = 0;      ///< s, the sum of when each does
    double stops = 0;        ///< s, the sum of what they stop on the way
    double length = 0;       ///< m, of all paths
    double turns = 0;        ///< rad, the sum of all that they turn
    double nearest = apart;  ///< m, between the centres of two of them; at most `apart`
    double unclear = 0;      ///< how many plans conflict still
    double stuck = 0;        ///< how many have no way
    static constexpr double apart = 2;
};
static_assert(sizeof(TeamEstimate) == 8 * 8, "without padding");

struct TeamPlan {
    std::vector<Plan> plans;  ///< of each member
    TeamEstimate estimate;
};

/// Plans one member after the other. `drive` says how fast they are; their headings are their own. `separation`: m,
/// between their centres.
TeamPlan teamPlan(std::span<const TeamMember> team, const DiscSpace& space, const TeamMethod& method,
                  const DriveTimes& drive, double separation);

}  // namespace mrose
