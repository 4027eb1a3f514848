#pragma once

#include <span>
#include <string>

namespace mrose {

// JSON schemas of the messages that other programs read in a recording. Those of Foxglove's own messages are as it
// publishes them (docs.foxglove.dev, "Message schemas"), without their prose.

std::string frameTransformsSchema();  ///< foxglove.FrameTransforms
std::string sceneUpdateSchema();      ///< foxglove.SceneUpdate
std::string logSchema();              ///< foxglove.Log

/// Objects of numbers, one for each of the names (body_names.h).
std::string robotsSchema(std::span<const std::string> names);
std::string objectsSchema(std::span<const std::string> names);
std::string contactsSchema();

}  // namespace mrose
