#pragma once

#include <span>
#include <string>

#include "scenario/scenario.h"

namespace mrose {

/// What of a scenario stays the same, as a foxglove.SceneUpdate: walls, floor, markings and goals in the frame "world",
/// and every body in its own frame, named frames[body], along with which it moves. What is flat in a description gets a
/// height here, so that it can be looked at in three dimensions.
std::string sceneMessage(const Scenario& scenario, std::span<const std::string> frames, Nanoseconds time);

}  // namespace mrose
