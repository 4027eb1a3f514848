#pragma once

#include <string>

#include "assessment/evaluate.h"

namespace mrose {

/// How the floor was found, what it holds, and every model on the stretches of its pairs, as a part of the evaluation's
/// page; nothing where no floor was looked for.
std::string floorSection(const Evaluation& evaluation);

}  // namespace mrose
