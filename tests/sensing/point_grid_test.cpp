#include "scene/point_grid.h"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "geometry/polygon.h"
#include "world/noise.h"

namespace mrose {
namespace {

double uniform(std::uint64_t scene, std::int64_t which, double least, double most) {
    return least + (most - least) * uniformNoise({scene, which, 0, 0});
}

/// Some crowds: even, thin and long, with stragglers, in rows, in one place.
std::vector<Point> places(std::uint64_t scene) {
    const double width = scene % 3 == 0 ? 300 : 20, height = scene % 4 == 0 ? 0 : 15;
    std::vector<Point> points;
    for (std::int64_t i = 0; i < 200; ++i) {
        Point point{uniform(scene, 2 * i, -width, width), uniform(scene, 2 * i + 1, -height, height)};
        if (scene % 5 == 1) point = {std::round(point.x), std::round(point.y)};
        if (scene % 5 == 2 && i % 50 == 0) point = 100 * point;
        if (scene % 5 == 3) point = {7, 7};
        points.push_back(point);
    }
    return points;
}

constexpr std::uint64_t scenes = 20;

TEST(PointGrid, BoxHoldsAllOfItsPoints) {
    for (std::uint64_t scene = 0; scene < scenes; ++scene) {
        const std::vector<Point> points = places(scene);
        PointGrid grid;
        for (const double side : {0.0, 3.0, std::numeric_limits<double>::infinity()}) {
            grid.fill(points, side, 1);
            for (std::int64_t box = 0; box < 50; ++box) {
                const Point& least = points[static_cast<std::size_t>(4 * box)];
                const Point most = least + Point{uniform(scene, 1000 + box, 0, 9), uniform(scene, 2000 + box, 0, 9)};
                std::multiset<std::uint32_t> visited;
                grid.visitBox(least, most, [&](std::span<const PointGrid::Entry> entries) {
                    for (const PointGrid::Entry& entry : entries) {
                        EXPECT_EQ(entry.point, points[entry.number]);
                        visited.insert(entry.number);
                    }
                });
                for (std::uint32_t i = 0; i < points.size(); ++i) {
                    const Point& p = points[i];
                    const bool inside = p.x >= least.x && p.x <= most.x && p.y >= least.y && p.y <= most.y;
                    EXPECT_LE(visited.count(i), 1u);
                    EXPECT_TRUE(!inside || visited.count(i) == 1) << scene << ' ' << side << ' ' << i;
                }
            }
        }
    }
}

TEST(PointGrid, LineMeetsAllNearIt) {
    std::size_t asked = 0, pairs = 0;
    for (std::uint64_t scene = 0; scene < scenes; ++scene) {
        const std::vector<Point> points = places(scene);
        PointGrid grid;
        grid.fill(points, 0, 1);
        for (std::size_t line = 0; line + 1 < points.size(); line += 3) {
            const Point &from = points[line], &to = points[line + 1];
            const double reach = uniform(scene, static_cast<std::int64_t>(3000 + line), 0, 2);
            std::multiset<std::uint32_t> met;
            EXPECT_FALSE(grid.anyAlong(from, to, reach, [&](const PointGrid::Entry& entry) {
                met.insert(entry.number);
                return false;
            }));
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                const bool near = distanceToSegment(points[i], from, to) <= reach;
                EXPECT_LE(met.count(i), 1u);
                EXPECT_TRUE(!near || met.count(i) == 1) << scene << ' ' << line << ' ' << i;
            }
            asked += met.size();
            pairs += points.size();
            const std::uint32_t last = static_cast<std::uint32_t>(line + 1);
            EXPECT_TRUE(grid.anyAlong(from, to, reach, [&](const PointGrid::Entry& e) { return e.number == last; }));
        }
    }
    EXPECT_LT(asked, pairs / 2);
}

TEST(PointGrid, SpreadsOutwardsToAllThatIsEntered) {
    PointGrid::Spreading memory;
    for (std::uint64_t scene = 0; scene < scenes; ++scene) {
        const std::vector<Point> points = places(scene);
        PointGrid grid;
        grid.fill(points, 0, 1);
        for (std::size_t start = 0; start < points.size(); start += 7) {
            const Point& from = points[start];
            const double end = start % 2 == 0 ? std::numeric_limits<double>::infinity() : 3;
            double passed = 0, entered = 0;
            std::multiset<std::uint32_t> visited;
            PointGrid::Box box;
            const auto enter = [&](const PointGrid::Box& its, double nearest) {
                EXPECT_GE(nearest, passed);
                box = its, entered = nearest;
                return nearest <= end;
            };
            const auto visit = [&](std::span<const PointGrid::Entry> entries) {
                for (const PointGrid::Entry& entry : entries) {
                    visited.insert(entry.number);
                    EXPECT_TRUE(entry.point.x >= box.least.x && entry.point.x <= box.most.x);
                    EXPECT_TRUE(entry.point.y >= box.least.y && entry.point.y <= box.most.y);
                    EXPECT_GE(distance(entry.point, from), entered);
                }
            };
            grid.spread(from, memory, enter, visit, [&](double nearest) {
                EXPECT_GE(nearest, passed);
                passed = nearest;
            });
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                EXPECT_LE(visited.count(i), 1u);
                EXPECT_TRUE(distance(points[i], from) > end || visited.count(i) == 1) << scene << ' ' << i;
            }
        }
    }
}

TEST(PointGrid, NoPointsAndPointsWithoutEnd) {
    PointGrid grid;
    grid.fill({}, 1, 1);
    grid.visitNeighbours([](std::uint32_t, std::uint32_t) { ADD_FAILURE(); });
    const double far = std::numeric_limits<double>::infinity();
    const std::vector<Point> points{{0, 0}, {far, 1}, {2, std::nan("")}, {-far, -far}, {1e308, -1e308}};
    grid.fill(points, 0, 1);
    std::size_t count = 0;
    grid.visitBox({-1, -1}, {1, 1}, [&](std::span<const PointGrid::Entry> entries) { count += entries.size(); });
    EXPECT_EQ(count, points.size());
}

}  // namespace
}  // namespace mrose
