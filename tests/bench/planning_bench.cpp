// What planning costs: the plans of four robots among four boxes on the Mid-Size field, by each planner, and by each
// repair where they conflict; of one of them alone: planning_bench imagined_obstacle.
#include <cstdio>
#include <limits>
#include <string>

#include "bench/timing.h"
#include "planning/repairs.h"
#include "planning/voronoi_roadmap.h"

namespace mrose::bench {
namespace {

constexpr double radius = 0.37, boxRadius = 0.25, separation = 0.67;

/// The side walls, in pieces as an environment has them.
std::vector<ConvexPiece> field() {
    std::vector<ConvexPiece> pieces;
    const Polygon half{{-4.5, -1}, {-4.5, -2.3}, {-4.3, -2.5}, {4.3, -2.5}, {4.5, -2.3}, {4.5, -1}, {5, -1}, {5, 1}};
    for (const double side : {1.0, -1.0})
        for (std::size_t i = 1; i < half.size(); ++i) {
            const Point a = side * half[i - 1], b = side * half[i];
            const Point out = (0.05 / distance(a, b)) * Point{(b - a).y, -(b - a).x};
            pieces.push_back(*ConvexPiece::polygon({a, a + out, b + out, b}));
        }
    for (const Point& box : {Point{-1.2, 0.9}, Point{0.9, -0.6}, Point{1.6, 1.6}, Point{-1.4, -1.5}})
        pieces.push_back(ConvexPiece::circle(box, boxRadius));
    return pieces;
}

struct Way {
    Point start, goal;
};
constexpr Way ways[] = {
    {{-3, -1.2}, {3, 1.2}}, {{3, -1.2}, {-3, 1.0}}, {{-3, 1.3}, {2.6, -1.5}}, {{0, 1.9}, {0.4, -1.8}}};

/// The quickest of many rounds: others may be at work.
template <class Work>
double microseconds(const Work& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 500; ++round) least = std::min(least, secondsOf(work));
    return 1e6 * least;
}

bool asked(std::string_view name, const std::string& only) { return only.empty() || name == only; }

void planners(const DiscSpace& space, const std::string& only) {
    std::printf("four robots among four boxes, us for all four\n");
    double sum = 0;
    for (std::size_t i = 0; i < plannerNames.size(); ++i)
        if (asked(plannerNames[i], only))
            std::printf("  %-34s %7.1f\n", std::string(plannerNames[i]).c_str(), microseconds([&] {
                            const PathFinder finder(static_cast<Planner>(i), space);
                            for (const Way& way : ways) sum += lengthOf(finder.path(way.start, way.goal));
                        }));
    const VoronoiRoadmap roadmap(space);
    if (asked(plannerNames[static_cast<std::size_t>(Planner::voronoi)], only))
        std::printf("  %-34s %7.1f\n", "voronoi, its roadmap there", microseconds([&] {
                        for (const Way& way : ways) sum += lengthOf(roadmap.path(way.start, way.goal));
                    }));
    if (sum < 0) std::printf("%g\n", sum);
}

void repairs(const DiscSpace& space, const std::string& only) {
    std::printf("the same with repairs, each giving way to those before it (visibility graph)\n");
    for (std::size_t repair = 0; repair < repairNames.size(); ++repair) {
        if (!asked(repairNames[repair], only)) continue;
        int clear = 0;
        const double cost = microseconds([&] {
            std::vector<TimedPath> others;
            const PathFinder finder(Planner::visibilityGraph, space);
            clear = 0;
            for (const Way& way : ways) {
                const DriveTimes drive{.heading = 0, .speed = 0.4, .rotation = 1};
                const Plan plan =
                    repairedPlan({finder, static_cast<Repair>(repair), way.start, way.goal, drive, others, separation});
                others.push_back(plan.timed(drive));
                clear += plan.clear ? 1 : 0;
            }
        });
        std::printf("  %-34s %7.1f, %d of 4 clear\n", std::string(repairNames[repair]).c_str(), cost, clear);
    }
}

}  // namespace
}  // namespace mrose::bench

int main(int count, char** arguments) {
    const mrose::DiscSpace space(mrose::bench::field(), mrose::bench::radius);
    const std::string only = count > 1 ? arguments[1] : "";
    mrose::bench::planners(space, only);
    mrose::bench::repairs(space, only);
    return 0;
}
