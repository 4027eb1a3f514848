#include "synthetic/reference_perception.h"

#include "sensing/odometry.h"
#include "synthetic/reference_self.h"
#include "synthetic/reference_sight.h"

namespace mrose {

std::vector<SensorPointer> referenceSensors(const Perception& perception, const Environment& environment) {
    return {std::make_shared<const ReferenceSelf>(perception.self, perception.errorScale, worldLandmarks(environment)),
            std::make_shared<const ReferenceSight>(perception.robots, perception.objects, perception.errorScale),
            std::make_shared<const Odometry>(perception.velocityNoise, perception.rotationNoise)};
}

}  // namespace mrose
