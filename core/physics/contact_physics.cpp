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

void findClusters(const ContactTask& task, std::vector<ContactCluster>& clusters) {
    clusters.clear();
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
}

}  // namespace

ContactSolver::ContactSolver() : world_(std::make_unique<ContactWorld>()) {}
ContactSolver::~ContactSolver() = default;

void ContactSolver::solve(const ContactTask& task, std::span<const ContactImpulse> before,
                          std::vector<ContactImpulse>& after, std::vector<ContactOutcome>& outcomes,
                          std::vector<ContactReport>* reports) {
    after.clear();
    outcomes.resize(task.bodies.size());
    findClusters(task, clusters_);
    for (std::size_t first = 0, last = 0; first < clusters_.size(); first = last) {
        const std::size_t end = clusters_[first].firstBody + bodiesPerWorld;
        for (last = first + 1; last < clusters_.size() && clusters_[last].lastBody <= end;) ++last;
        world_->solve(task, before, std::span(clusters_).subspan(first, last - first), outcomes, after, reports);
    }
    std::sort(after.begin(), after.end(), keyLess);
}

}  // namespace mrose
