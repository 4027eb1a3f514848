#pragma once

#include "io/error.h"
#include "scenario/description_library.h"

namespace mrose {

/// The content of a file that describes a sensor as it is sold, for robot files to name; what it refers to is in it.
/// Error: file, line, column and key of the first thing wrong.
Expected<Value> readSensorPreset(const Value::File& file, DescriptionLibrary& library);
/// What of it is a sensor's.
Value presetKeys(Value content);

}  // namespace mrose
