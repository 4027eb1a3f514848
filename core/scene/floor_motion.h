#pragma once

#include <memory>

#include "scene/object_model.h"

namespace mrose {

constexpr double gravity = 9.81;  // m/s2

/// Where a free body on the floor is after `duration` seconds without touch. A ball slides, its slip shrinking by
/// friction (Coulomb), until it rolls; then it slows down evenly until it rests: in closed form, so that no step's
/// length matters. Other bodies slide and turn until friction has stopped them. `frictionFactor` scales both frictions.
ObjectState afterFloorMotion(const ObjectState& state, const ObjectType& type, const FloorSurface& floor,
                             double frictionFactor, double duration);

/// Objects that roll or slide by the friction of the floor, with a random factor on it each tick: the paper's.
class FloorMotion final : public ObjectModel {
public:
    ObjectState after(const ObjectInput& input) const override;
};

/// One for all.
std::shared_ptr<const ObjectModel> floorMotion();

}  // namespace mrose
