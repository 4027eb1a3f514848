#include "motion/kinematic_baselines.h"

#include <algorithm>

namespace mrose {

std::vector<KinematicBaseline> kinematicBaselines(const MotionNetwork& network, const std::string& robot) {
    std::vector<KinematicBaseline> baselines{{"velocity = command", {}}};
    if (network.identified.empty()) return baselines;
    const auto found =
        std::find_if(network.identified.begin(), network.identified.end(),
                     [&](const MotionNetwork::Identified& identified) { return identified.robot == robot; });
    const MotionNetwork::Identified& known = found == network.identified.end() ? network.identified.front() : *found;
    baselines.push_back({"+ dead time", known.delayed});
    baselines.push_back({"+ lag, gains, biases", known.dynamic});
    return baselines;
}

}  // namespace mrose
