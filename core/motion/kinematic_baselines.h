#pragma once

#include <string>
#include <vector>

#include "motion/motion_network.h"

namespace mrose {

struct KinematicBaseline {
    std::string name;
    KinematicParameters parameters;
};

/// What a network is compared with: velocity = command; the same after the dead time identified for a robot; with lag,
/// gains and biases as well. They were identified from the logs that the network was learned from; for a robot that is
/// unknown to it the first of the known stands in, and a network without any has the first baseline alone.
std::vector<KinematicBaseline> kinematicBaselines(const MotionNetwork& network, const std::string& robot);

}  // namespace mrose
