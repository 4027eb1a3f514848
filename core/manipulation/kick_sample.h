#pragma once

#include "manipulation/kick_network.h"

namespace mrose {

/// What a log says of one kick.
struct KickSample {
    KickState state;       ///< when it acted
    Velocity atCommand;    ///< the robot's motion when it was commanded
    bool hit = false;      ///< the ball left; else nothing of what follows
    double delay = 0;      ///< s, from the command to when the ball left
    double speed = 0;      ///< m/s
    double direction = 0;  ///< rad, in the robot's frame

    /// As LearnedKicker::delay() reads it.
    KickState commanded() const { return {state.power, atCommand, state.ball_B}; }
};

}  // namespace mrose
