#include "assessment/sensed_look.h"

#include <algorithm>
#include <cmath>

#include "geometry/pose.h"

namespace mrose {

double SensedSubject::reportedBearing() const { return wrapAngle(bearing + bearingError); }

bool SensedLook::empty() const { return std::ranges::none_of(subjects, &SensedSubject::reported); }

bool SensorField::holds(double distance, double bearing) const {
    return (range == 0 || distance <= range) && std::abs(wrapAngle(bearing - direction)) <= 0.5 * fieldOfView;
}

}  // namespace mrose
