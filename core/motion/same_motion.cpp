#include "motion/same_motion.h"

namespace mrose {

bool sameMotion(const MotionModel& one, const MotionModel& other) {
    const MotionModel &a = one.underlying(), &b = other.underlying();
    return &a == &b || a.sameAs(b);
}

}  // namespace mrose
