#include "scene/environment.h"

namespace mrose {
namespace {

Point landmarkPosition(const Shape& shape) {
    const bool circle = shape.parts.size() == 1 && shape.parts.front().polygon.empty();
    return circle ? shape.parts.front().centre : shape.centroid;
}

}  // namespace

std::vector<Landmark> landmarksOf(const Environment& environment) {
    std::vector<Landmark> landmarks;
    for (std::uint32_t i = 0; i < environment.obstacles.size(); ++i) {
        const Obstacle& obstacle = environment.obstacles[i];
        if (!obstacle.landmark.empty()) landmarks.push_back({obstacle.landmark, landmarkPosition(obstacle.shape), i});
    }
    return landmarks;
}

}  // namespace mrose
