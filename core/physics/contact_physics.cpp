#include "physics/contact_physics.h"

#include <algorithm>
#include <cmath>

#include "physics/contact_world.h"

namespace mrose {
namespace {

// Small clusters share a world, which spares most of its cost; Box2D's lists and trees grow with the bodies.
constexpr std::size_t bodiesPerWorld = 64;

Point originNear(const Pose& pose) {
    constexpr double grid = 32;  // m
    return {std::round(pose.x / grid) * grid, std::round(pose.y / grid) * grid};
}

std::vector<ContactCluster> clustersOf(const ContactTask& task) {
    std::vector<ContactCluster> clusters;
    std::size_t obstacle = 0;
    for (std::size_t i = 0; i < task.bodies.size();) {
        const std::uint32_t name = task.bodies[i].cluster;
        ContactCluster cluster;
        cluster.firstBody = i;
        cluster.lightest = cluster.heaviest = task.bodies[i].mass;
        cluster.origin = originNear(task.bodies[i].pose);
        for (; i < task.bodies.size() && task.bodies[i].cluster == name; ++i) {
            cluster.lightest = std::min(cluster.lightest, task.bodies[i].mass);
            cluster.heaviest = std::max(cluster.heaviest, task.bodies[i].mass);
        }
        cluster.lastBody = i;
        cluster.firstObstacle = obstacle;
        while (obstacle < task.obstacles.size() && task.obstacles[obstacle].cluster == name) ++obstacle;
        cluster.lastObstacle = obstacle;
        clusters.push_back(cluster);
    }
    return clusters;
}

}  // namespace

void solveContacts(const ContactTask& task, std::span<const ContactImpulse> before, std::vector<ContactImpulse>& after,
                   std::vector<ContactOutcome>& outcomes, std::vector<ContactReport>* reports) {
    after.clear();
    outcomes.resize(task.bodies.size());
    const std::vector<ContactCluster> clusters = clustersOf(task);
    for (std::size_t first = 0, last = 0; first < clusters.size(); first = last) {
        const std::size_t end = clusters[first].firstBody + bodiesPerWorld;
        for (last = first + 1; last < clusters.size() && clusters[last].lastBody <= end;) ++last;
        ContactWorld world(task, before, std::span(clusters).subspan(first, last - first));
        world.solve(outcomes);
        world.collect(after, reports);
    }
    std::sort(after.begin(), after.end(), keyLess);
}

}  // namespace mrose
