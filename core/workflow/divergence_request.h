#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/compared_divergences.h"

namespace mrose {

/// Where simulated robots leave the real trajectory, and why: what the flags of `mrose compare` say of it.
struct DivergenceRequest {
    std::optional<double> position, heading;  ///< m, degrees; neither: what the networks' held-out errors make likely
    double held = 0.3;                        ///< s
    bool noCauses = false;
    std::vector<std::string> models = {};  ///< that may explain it, beside those of modelsToTry(): network files
};

/// The same with its models opened. Error: as of modelsToTry().
Expected<DivergenceOptions> divergenceOptions(const LogWorld& world, const DivergenceRequest& request);

}  // namespace mrose
