#pragma once

#include <optional>
#include <string>

#include "debug/field_frame.h"

namespace mrose {

/// Why a body cannot be put there, beside all others where they are: "on blue 3", "on wall", "outside the field";
/// empty: it can.
std::string hindranceAt(const FieldFrame& frame, std::size_t body, const Pose& pose);

/// The nearest place to a pose, up to some cm, at which nothing hinders the body, turned as it is; nullopt: there is
/// none within `reach` m.
std::optional<Pose> freePlaceNear(const FieldFrame& frame, std::size_t body, const Pose& pose, double reach = 1);

}  // namespace mrose
