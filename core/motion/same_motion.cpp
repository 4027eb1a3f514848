#include "motion/same_motion.h"

#include "motion/kinematic.h"
#include "motion/learned_model.h"

namespace mrose {

bool sameMotion(const MotionModel& one, const MotionModel& other) {
    const MotionModel &a = one.underlying(), &b = other.underlying();
    if (&a == &b) return true;
    const auto *const kinematicA = dynamic_cast<const KinematicModel*>(&a), *const kinematicB =
                                                                                dynamic_cast<const KinematicModel*>(&b);
    if (kinematicA != nullptr && kinematicB != nullptr)
        return kinematicA->parameters() == kinematicB->parameters() && a.period() == b.period();
    const LearnedModel *const learnedA = learnedModel(a), *const learnedB = learnedModel(b);
    return learnedA != nullptr && learnedB != nullptr && learnedA->network() == learnedB->network() &&
           learnedA->robot() == learnedB->robot();
}

}  // namespace mrose
