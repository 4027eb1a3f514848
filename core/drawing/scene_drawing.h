#pragma once

#include <span>
#include <string>
#include <vector>

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
/// A path through an environment, interrupted where a pose is not finite, with an arrow at its end.
struct DrawnPath {
    std::vector<Pose> poses;
    Colour colour;
    bool dashed = false;
    std::string name;  ///< written at its first pose; may be empty
};
std::string drawPaths(const Environment& environment, const std::string& title, const std::string& subtitle,
                      std::span<const DrawnPath> paths);
/// All bodies where they start.
std::string drawScene(const Scene& scene, const std::string& title, const DrawingOptions& options = {});

}  // namespace mrose
