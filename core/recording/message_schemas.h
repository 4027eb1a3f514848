#pragma once

#include <span>
#include <string>

#include "control/reading.h"

namespace mrose {

// JSON schemas of the messages that other programs read in a recording. Those of Foxglove's own messages are as it
// publishes them (docs.foxglove.dev, "Message schemas"), without their prose.

std::string frameTransformsSchema();  ///< foxglove.FrameTransforms
std::string sceneUpdateSchema();      ///< foxglove.SceneUpdate
std::string logSchema();              ///< foxglove.Log
std::string laserScanSchema();        ///< foxglove.LaserScan
std::string pointCloudSchema();       ///< foxglove.PointCloud
std::string radioSchema();            ///< mrose.Radio

/// "mrose.Reading.pose": an array of records, each an object of the type's numbers.
std::string readingTitle(const RecordType& type);
std::string readingSchema(const RecordType& type);

/// An object of numbers for each body; `names` (body_names.h) of robots and of objects.
std::string bodiesSchema(std::span<const std::string> robots, std::span<const std::string> objects);

}  // namespace mrose
