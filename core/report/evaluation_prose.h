#pragma once

#include <string>

#include "assessment/evaluate.h"

namespace mrose {

/// How the floor was found and what it holds, as markup for one paragraph.
std::string floorText(const Floor& floor);
std::string turningFloorText(const Floor& floor);

/// What the report's terms mean, as a definition list.
std::string definitions(const Evaluation& evaluation);

}  // namespace mrose
