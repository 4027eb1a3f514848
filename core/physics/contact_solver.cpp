#include "physics/contact_solver.h"

#include "physics/first_touches.h"
#include "physics/kept_impulses.h"
#include "physics/next_event.h"
#include "physics/outcomes.h"
#include "physics/overlaps.h"

namespace mrose {

void ContactSolver::solve(const ContactTick& tick, const ContactCluster& cluster,
                          std::span<const ContactImpulse> before, std::vector<ContactImpulse>& after,
                          std::span<ContactOutcome> outcomes, std::vector<ContactReport>* reports) {
    cluster_.tick = &tick;
    cluster_.cluster = &cluster;
    cluster_.bodies.clear();
    for (const ContactBody& body : cluster.bodies) cluster_.bodies.emplace_back(body, tick.duration);
    findMeetings(tick, cluster, cluster_.meetings);
    findFirstTouches(cluster_, before, starting_);
    for (const std::uint32_t island : starting_) islandSolver_.solveAtStart(cluster_, island);
    goThroughTick();
    pressOut(cluster_.bodies, cluster_.meetings, tick.duration);
    for (const Meeting& meeting : cluster_.meetings) {
        if (pressesOn(cluster_, meeting)) keepImpulses(keyOf(cluster, meeting), meeting, after);
        if (reports != nullptr && worthReporting(meeting)) reports->push_back(reportOf(cluster, meeting));
    }
    for (std::size_t i = 0; i < cluster_.bodies.size(); ++i) outcomes[i] = outcomeOf(cluster_.bodies[i], tick.duration);
}

/// From event to event, in the order of time.
void ContactSolver::goThroughTick() {
    for (Meeting& meeting : cluster_.meetings) findNextEvent(cluster_, meeting, 0);
    while (true) {
        Meeting* first = nullptr;
        for (Meeting& meeting : cluster_.meetings)
            if (meeting.next < (first != nullptr ? first->next : never)) first = &meeting;
        if (first == nullptr) return;
        const double time = first->next;
        cluster_.join(*first);
        islandSolver_.solveAt(cluster_, time, cluster_.islands.of(first->a), *first, changed_);
        for (Meeting* meeting : changed_) findNextEvent(cluster_, *meeting, time);
    }
}

}  // namespace mrose
