#pragma once

#include <filesystem>
#include <string>

namespace mrose {

/// The root of the source, where nets/ and resources/ are.
std::filesystem::path sourceFolder();

/// The program `mrose` of this build.
std::string mroseProgram();

}  // namespace mrose
