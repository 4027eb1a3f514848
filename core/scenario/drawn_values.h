#pragma once

#include <string>
#include <vector>

#include "io/value.h"

namespace mrose {

/// What was drawn for a trial of an experiment: numbers, texts or truths, each by its name.
struct DrawnValue {
    std::string name;
    Value value;
};
using DrawnValues = std::vector<DrawnValue>;

}  // namespace mrose
