#pragma once

#include "io/toml_table.h"
#include "scene/perception.h"

namespace mrose {

/// The part [perception] of a robot file. For .cpp files of loaders: it shows TomlTable.
Perception readPerception(TomlTable table);

}  // namespace mrose
