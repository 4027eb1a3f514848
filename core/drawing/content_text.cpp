#include "drawing/content_text.h"

#include <algorithm>

namespace mrose {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::string contentText(const Shape& shape) {
    return counted(shape.parts.size(), "part", "parts") + ", " +
           counted(shape.pieces.size(), "convex piece", "convex pieces");
}

std::string contentText(const Environment& environment) {
    const auto walls =
        static_cast<std::size_t>(std::count_if(environment.obstacles.begin(), environment.obstacles.end(),
                                               [](const Obstacle& obstacle) { return obstacle.wall; }));
    return counted(walls, "wall", "walls") + ", " +
           counted(environment.obstacles.size() - walls, "other obstacle", "other obstacles") + ", " +
           counted(environment.goals.size(), "goal", "goals");
}

std::string contentText(const Scene& scene) {
    std::size_t persons = 0;
    for (std::size_t i = 0; i < scene.robots.size(); ++i) persons += scene.typeOf(i).person ? 1 : 0;
    std::string text = counted(scene.robots.size() - persons, "robot", "robots");
    if (persons > 0) text += ", " + counted(persons, "person", "persons");
    return text + ", " + counted(scene.objects.size(), "object", "objects");
}

}  // namespace mrose
