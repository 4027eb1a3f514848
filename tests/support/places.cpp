#include "support/places.h"

namespace mrose {

std::filesystem::path sourceFolder() { return MROSE_SOURCE_DIR; }
std::string mroseProgram() { return MROSE_PROGRAM; }

}  // namespace mrose
