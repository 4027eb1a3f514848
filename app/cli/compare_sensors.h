#pragma once

#include "assessment/compare.h"

namespace mrose::cli {

/// What sensors reported, for people; nothing where none was compared.
void printSensors(const Comparison& comparison);

}  // namespace mrose::cli
