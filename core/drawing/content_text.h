#pragma once

#include <string>

#include "geometry/shape.h"
#include "scene/environment.h"
#include "scene/scene.h"

namespace mrose {

// What a description holds: "3 parts, 3 convex pieces"; "4 walls, 0 other obstacles, 2 goals"; "1 robot, 3 persons, 1
// object".
std::string contentText(const Shape& shape);
std::string contentText(const Environment& environment);
std::string contentText(const Scene& scene);

}  // namespace mrose
