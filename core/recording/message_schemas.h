#pragma once

#include <span>
#include <string>

namespace mrose {

// JSON schemas of the messages that other programs read in a recording. Those of Foxglove's own messages are as it
// publishes them (docs.foxglove.dev, "Message schemas"), without their prose.

std::string frameTransformsSchema();  ///< foxglove.FrameTransforms
std::string sceneUpdateSchema();      ///< foxglove.SceneUpdate
std::string logSchema();              ///< foxglove.Log
std::string radioSchema();            ///< mrose.Radio

/// An object of numbers for each body; `names` (body_names.h) of robots and of objects.
std::string bodiesSchema(std::span<const std::string> robots, std::span<const std::string> objects);

}  // namespace mrose
