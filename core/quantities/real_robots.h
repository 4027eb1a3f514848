#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "world/command.h"
#include "world/time.h"

namespace mrose {

/// m, and rad, absolute, wrapped.
struct PoseError {
    double position = 0, heading = 0;
};
PoseError poseError(const Pose& real, const Pose& simulated);

/// The real robots beside which simulated ones drive, on the run's clock. This one knows nothing of any.
class RealRobots {
public:
    virtual ~RealRobots() = default;

    /// Where the real robot of a simulated one is; nullopt where it is not known.
    virtual std::optional<Pose> poseOf(const std::string& /*robot*/, Nanoseconds /*now*/) const { return {}; }
    /// How fast it is then.
    virtual std::optional<Velocity> velocityOf(const std::string& /*robot*/, Nanoseconds /*now*/) const { return {}; }
    /// Motion models that were given the same start and the same commands.
    virtual std::vector<std::string> modelNames() const { return {}; }
    /// How far a model is from the real robot of a simulated one, at the last of the model's instants up to `now`.
    virtual std::optional<PoseError> errorOf(const std::string& /*model*/, const std::string& /*robot*/,
                                             Nanoseconds /*now*/) const {
        return {};
    }
};

}  // namespace mrose
