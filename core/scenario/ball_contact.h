#pragma once

#include "geometry/shape.h"

namespace mrose {

/// How far ahead of the shape's reference point the nearest point of a ball lies that touches it, the ball's centre
/// being on the x axis: the front that a robot meets a ball with. Exact to a micrometre.
double ballContact(const Shape& shape, double ballRadius);

}  // namespace mrose
