#pragma once

#include "scene/scene.h"
#include "world/world_state.h"

namespace mrose {

constexpr double gravity = 9.81;  // m/s2

/// Where a free body on the floor is after `duration` seconds without touch. A ball slides, its slip shrinking by
/// friction (Coulomb), until it rolls; then it slows down evenly until it rests: in closed form, so that no step's
/// length matters. Other bodies slide and turn until friction has stopped them. `frictionFactor` scales both frictions.
ObjectState afterFloorMotion(const ObjectState& state, const ObjectType& type, const FloorSurface& floor,
                             double frictionFactor, double duration);

/// The same where it stays meanwhile: how the floor has changed its velocities.
ObjectState slowedByFloor(const ObjectState& state, const ObjectType& type, const FloorSurface& floor,
                          double frictionFactor, double duration);

}  // namespace mrose
