#include "planning/planning_worlds.h"

#include <limits>
#include <queue>

#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {

double drawnNumber(std::uint64_t seed, std::int64_t which, std::uint32_t part, double least, double most) {
    return least + (most - least) * uniformNoise({seed, which, part, channelOf(NoiseChannel::trial)});
}

ConvexPiece boxPiece(const Pose& pose, double length, double width) {
    const Placement placement(pose);
    Polygon corners;
    for (const Point& corner : {Point{-1, -1}, Point{1, -1}, Point{1, 1}, Point{-1, 1}})
        corners.push_back(placement.place({corner.x * length / 2, corner.y * width / 2}));
    return *ConvexPiece::polygon(corners);
}

std::vector<ConvexPiece> room(double width, double height) {
    constexpr double thick = 0.2;
    return {boxPiece({width / 2, -thick / 2, 0}, width + 2 * thick, thick),
            boxPiece({width / 2, height + thick / 2, 0}, width + 2 * thick, thick),
            boxPiece({-thick / 2, height / 2, 0}, thick, height),
            boxPiece({width + thick / 2, height / 2, 0}, thick, height)};
}

DiscSpace drawnRoom(std::uint64_t seed, std::int64_t which) {
    std::vector<ConvexPiece> pieces = room(6, 4);
    const int count = static_cast<int>(drawnNumber(seed, which, 0, 0, 6.999));
    for (int i = 0; i < count; ++i) {
        const auto part = static_cast<std::uint32_t>(10 * (i + 1));
        const Pose pose{drawnNumber(seed, which, part, 0.5, 5.5), drawnNumber(seed, which, part + 1, 0.5, 3.5),
                        drawnNumber(seed, which, part + 2, -3, 3)};
        const double size = drawnNumber(seed, which, part + 3, 0.2, 1.2);
        if (drawnNumber(seed, which, part + 4, 0, 1) < 0.4)
            pieces.push_back(ConvexPiece::circle(position(pose), size / 2));
        else
            pieces.push_back(boxPiece(pose, size, drawnNumber(seed, which, part + 5, 0.1, 1.0)));
    }
    return {std::move(pieces), 0.25};
}

Point drawnPlace(const DiscSpace& space, std::uint64_t seed, std::int64_t which, std::uint32_t part) {
    for (std::uint32_t i = 0;; ++i) {
        const Point place{drawnNumber(seed, which, part + 2 * i, 0.3, 5.7),
                          drawnNumber(seed, which, part + 2 * i + 1, 0.3, 3.7)};
        if (space.free(place)) return place;
    }
}

double gridLength(const DiscSpace& space, const Point& start, const Point& goal, double cell, int reach) {
    const int columns = static_cast<int>(6 / cell) + 1, rows = static_cast<int>(4 / cell) + 1;
    std::vector<Point> places{start, goal};
    std::vector<int> at(static_cast<std::size_t>(columns * rows), -1);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const Point place{x * cell, y * cell};
            if (!space.free(place)) continue;
            at[static_cast<std::size_t>(y * columns + x)] = static_cast<int>(places.size());
            places.push_back(place);
        }
    std::vector<double> length(places.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
    const auto relax = [&](int from, int to) {
        const Point &a = places[static_cast<std::size_t>(from)], &b = places[static_cast<std::size_t>(to)];
        const double way = length[static_cast<std::size_t>(from)] + distance(a, b);
        if (way >= length[static_cast<std::size_t>(to)] || !space.free(a, b)) return;
        length[static_cast<std::size_t>(to)] = way;
        open.emplace(way, to);
    };
    length[0] = 0;
    open.emplace(0, 0);
    while (!open.empty()) {
        const auto [way, from] = open.top();
        open.pop();
        if (from == 1) return way;
        if (way > length[static_cast<std::size_t>(from)]) continue;
        const Point& place = places[static_cast<std::size_t>(from)];
        const int column = static_cast<int>(place.x / cell + 0.5), row = static_cast<int>(place.y / cell + 0.5);
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) {
                const int x = column + dx, y = row + dy;
                if (x < 0 || y < 0 || x >= columns || y >= rows) continue;
                if (const int to = at[static_cast<std::size_t>(y * columns + x)]; to >= 0) relax(from, to);
            }
        if (distance(place, goal) < 2 * reach * cell) relax(from, 1);
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace mrose
