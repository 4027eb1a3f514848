#pragma once

#include <QVector>
#include <map>

#include "quantities/value_key.h"
#include "scene/scene.h"
#include "simulation/motion_bands.h"
#include "widgets/plot_curve.h"

namespace mrose::gui {

/// Of the robots that have bands: x, y and heading by the intervals that hold half and 90 % of all runs; by how far
/// such runs are from the one without noise, the errors that a real robot has if the noise is right. In the units that
/// are plotted.
std::map<ValueKey, QVector<ExpectedRange>> expectedOf(const MotionBands& bands, const Scene& scene);

}  // namespace mrose::gui
