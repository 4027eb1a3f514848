#pragma once

#include <string>

#include "geometry/shape.h"
#include "scene/environment.h"
#include "scene/scene.h"

namespace mrose {

/// "1 wall", "4 walls".
std::string counted(std::size_t count, const std::string& one, const std::string& many);

// What a description holds: "3 parts, 3 convex pieces"; "4 walls, 0 other obstacles, 2 goals"; "1 robot, 3 persons, 1
// object".
std::string contentText(const Shape& shape);
std::string contentText(const Environment& environment);
std::string contentText(const Scene& scene);

}  // namespace mrose
