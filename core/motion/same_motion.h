#pragma once

#include "motion/motion_model.h"

namespace mrose {

/// Whether two models predict the same of everything, as far as their parameters tell and whatever noise is added:
/// descriptions that are loaded again make new models, also where nothing has changed.
bool sameMotion(const MotionModel& one, const MotionModel& other);

}  // namespace mrose
