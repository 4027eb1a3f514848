#pragma once

#include "drawing/scene_drawing.h"
#include "drawing/svg_drawing.h"

namespace mrose {

// What pictures of places and bodies share.

constexpr Colour black{20, 20, 20}, white{255, 255, 255};

void addShape(SvgDrawing& drawing, const Shape& shape, const Placement& at, const DrawingOptions& options);
/// `pale`: as the ground of something else, light, so that it stands back.
void addEnvironment(SvgDrawing& drawing, const Environment& environment, const DrawingOptions& options,
                    bool pale = false);

}  // namespace mrose
