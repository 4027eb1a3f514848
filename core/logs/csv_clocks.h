#pragma once

#include <string>
#include <vector>

#include "world/time.h"

namespace mrose {

/// From when to when the rows of one file are.
struct FileTimes {
    std::string file;  ///< its path
    Nanoseconds first = 0, last = 0;
};

/// Of files of one session, at least one, a sentence about those whose times are so far from the others' (an hour, and
/// ten times as long as either of them last) that their clock may be another; "": there are none.
std::string otherClockText(std::vector<FileTimes> files);

}  // namespace mrose
