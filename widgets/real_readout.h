#pragma once

#include <QString>
#include <optional>

#include "debug/real_robot.h"
#include "widgets/theme.h"
#include "widgets/view_transform.h"

namespace mrose {

/// The colour of a real robot, by RealRobot::place: of the simulated one's hue, nearer to that of writing; grey
/// without.
QColor realColour(std::optional<std::size_t> place, const Theme& theme);

/// "12 cm, 4.1 deg", with the sign of a degree.
QString errorText(const PoseError& error);
/// "real create 1: 12 cm, 4.1 deg away", or for how long it has not been seen.
QString realReadout(const FieldFrame& frame, const RealRobot& robot);
/// Of the real robot of a body, or without a body of those whose shapes lie at a point; empty: there is none.
QString realReadout(const FieldFrame& frame, std::optional<std::size_t> body, const Point& at);
/// How far each model is from the real robot of a body, a line each; empty: there are none.
QString modelReadout(const FieldFrame& frame, std::size_t body);

}  // namespace mrose
