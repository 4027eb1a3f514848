#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace mrose {

/// Bodies that do not fit beside one another at the start.
struct StartOverlap {
    std::size_t body = 0;              ///< the later one in the scene
    std::optional<std::size_t> other;  ///< the other body, or ...
    std::size_t obstacle = 0;          ///< ... this obstacle
    double depth = 0;                  ///< m
};

/// A pair that overlaps by more than `tolerance` at the start; nullopt where all fit. Quick where many bodies overlap,
/// too.
std::optional<StartOverlap> findStartOverlap(const Scene& scene, double tolerance = 1e-4);

/// The rectangle, along the axes, that the walls and the floor's area span.
struct SceneSpan {
    Point low, high;
    bool contains(const Point& p) const { return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y; }
};
/// nullopt where there is no wall.
std::optional<SceneSpan> spanOf(const Scene& scene);

/// Bodies that start outside it: most are a mistake.
std::vector<std::size_t> startsOutside(const Scene& scene);

}  // namespace mrose
