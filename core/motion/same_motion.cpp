#include "motion/same_motion.h"

#include "motion/kinematic.h"
#include "motion/learned_model.h"

namespace mrose {

bool sameMotion(const MotionModel& a, const MotionModel& b) {
    if (&a == &b) return true;
    const auto *const kinematicA = dynamic_cast<const KinematicModel*>(&a), *const kinematicB =
                                                                                dynamic_cast<const KinematicModel*>(&b);
    if (kinematicA != nullptr && kinematicB != nullptr)
        return kinematicA->parameters() == kinematicB->parameters() && a.period() == b.period();
    const auto *const learnedA = dynamic_cast<const LearnedModel*>(&a), *const learnedB =
                                                                            dynamic_cast<const LearnedModel*>(&b);
    return learnedA != nullptr && learnedB != nullptr && learnedA->network() == learnedB->network() &&
           learnedA->robot() == learnedB->robot();
}

}  // namespace mrose
