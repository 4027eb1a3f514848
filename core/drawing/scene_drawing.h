#pragma once

#include <string>

#include "geometry/shape.h"
#include "scene/environment.h"
#include "scene/robot_type.h"
#include "scene/scene.h"

namespace mrose {

struct DrawingOptions {
    bool pieces = false;  ///< the convex pieces too, by thin lines
};

// Descriptions as SVG: to scale, with a scale bar, names, headings and reference points.

std::string drawShape(const Shape& shape, const DrawingOptions& options = {});
/// Its shape, its manipulators with their reach, and how wide it sees.
std::string drawRobot(const RobotType& robot, const DrawingOptions& options = {});
std::string drawEnvironment(const Environment& environment, const DrawingOptions& options = {});
/// All bodies where they start.
std::string drawScene(const Scene& scene, const std::string& title, const DrawingOptions& options = {});

}  // namespace mrose
