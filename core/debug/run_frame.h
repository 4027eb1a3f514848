#pragma once

#include <optional>

#include "debug/field_frame.h"
#include "debug/time_travel.h"

namespace mrose {

/// How much of what lies around a tick is shown with it.
struct FrameOptions {
    std::size_t trailTicks = 500;
    Nanoseconds ahead = 2 * nanosecondsPerSecond;
    std::size_t mostBodiesAhead = 64;  ///< of more no path is predicted
    bool ghosts = true;
};
/// Of the shown tick.
FieldFrame frameOf(const TimeTravel& run, const FrameOptions& options = {});
/// Of another place in the shown branch's lineage.
FieldFrame frameOf(const TimeTravel& run, const Cursor& at, const FrameOptions& options);
/// Of the branch beside, at this tick or the nearest of its own; nullopt where there is none.
std::optional<FieldFrame> besideFrame(const TimeTravel& run, const FrameOptions& options);

}  // namespace mrose
