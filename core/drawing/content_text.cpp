#include "drawing/content_text.h"

#include <algorithm>

#include "io/format.h"

namespace mrose {

std::string contentText(const Shape& shape) {
    return counted(shape.parts.size(), "part") + ", " + counted(shape.pieces.size(), "convex piece");
}

std::string contentText(const Environment& environment) {
    const auto walls =
        static_cast<std::size_t>(std::count_if(environment.obstacles.begin(), environment.obstacles.end(),
                                               [](const Obstacle& obstacle) { return obstacle.wall; }));
    return counted(walls, "wall") + ", " + counted(environment.obstacles.size() - walls, "other obstacle") + ", " +
           counted(environment.goals.size(), "goal");
}

std::string contentText(const Scene& scene) {
    std::size_t persons = 0;
    for (std::size_t i = 0; i < scene.robots.size(); ++i) persons += scene.typeOf(i).person ? 1 : 0;
    std::string text = counted(scene.robots.size() - persons, "robot");
    if (persons > 0) text += ", " + counted(persons, "person");
    return text + ", " + counted(scene.objects.size(), "object");
}

}  // namespace mrose
