#pragma once

#include "motion/motion_network.h"

namespace mrose {

/// Whether delayed() can shift a network's inputs so: none of them would read the future, and those that are made from
/// both channels at once see both shifted alike. (Where wheels have a limit, it still cuts v and w of one instant.)
bool canDelay(const MotionNetwork& network, Nanoseconds laterV, Nanoseconds laterW);

/// The network of a robot that obeys its speed and its rotation so much later (earlier where negative), and is the same
/// otherwise: its inputs read the commands by so much longer ago.
MotionNetwork delayed(MotionNetwork network, Nanoseconds laterV, Nanoseconds laterW);

}  // namespace mrose
