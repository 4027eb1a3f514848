#include "assessment/sensed_look.h"

#include <algorithm>
#include <cmath>

#include "perception/logged_view.h"

namespace mrose {

double SensedSubject::reportedBearing() const { return wrappedAngle(bearing + bearingError); }

bool SensedLook::empty() const { return std::ranges::none_of(subjects, &SensedSubject::reported); }

bool SensorField::holds(double distance, double bearing) const {
    return (range == 0 || distance <= range) && std::abs(wrappedAngle(bearing - direction)) <= 0.5 * fieldOfView;
}

}  // namespace mrose
