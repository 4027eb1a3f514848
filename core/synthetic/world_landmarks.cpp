#include "synthetic/world_landmarks.h"

#include <algorithm>
#include <limits>

namespace mrose {
namespace {

constexpr std::size_t fewestNamed = 3;
constexpr double beaconsOutside = 6;  // m

struct Box {
    Point least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Point most{-least.x, -least.y};

    void hold(const Point& point) {
        least = {std::min(least.x, point.x), std::min(least.y, point.y)};
        most = {std::max(most.x, point.x), std::max(most.y, point.y)};
    }
    bool empty() const { return least.x > most.x; }
    Point middle() const { return 0.5 * (least + most); }
};

Box boxOf(const Environment& environment) {
    Box box;
    for (const Obstacle& obstacle : environment.obstacles)
        for (const ConvexPiece& piece : obstacle.shape.pieces)
            for (std::size_t i = 0; i < piece.count; ++i) box.hold(piece.corners[i]);
    for (const Point& point : environment.floor.area) box.hold(point);
    return box;
}

}  // namespace

WorldLandmarks worldLandmarks(const Environment& environment) {
    WorldLandmarks known;
    const Box box = boxOf(environment);
    if (!box.empty()) known.middle = box.middle();
    for (const Landmark& landmark : landmarksOf(environment)) known.points.push_back(landmark.position);
    if (known.points.size() < fewestNamed && !box.empty()) {
        const Point &least = box.least, &most = box.most;
        known.points = {least, {most.x, least.y}, most, {least.x, most.y}};
        const bool wide = most.x - least.x > most.y - least.y;
        known.points.push_back(wide ? Point{known.middle.x, least.y} : Point{least.x, known.middle.y});
        known.points.push_back(wide ? Point{known.middle.x, most.y} : Point{most.x, known.middle.y});
        for (const Goal& goal : environment.goals)
            known.points.insert(known.points.end(), goal.area.begin(), goal.area.end());
        const double out = beaconsOutside;
        known.points.insert(known.points.end(), {{least.x - out, least.y - out},
                                                 {most.x + out, least.y - out},
                                                 {most.x + out, most.y + out},
                                                 {least.x - out, most.y + out}});
    }
    if (known.points.size() > WorldLandmarks::most) known.points.resize(WorldLandmarks::most);
    return known;
}

}  // namespace mrose
