#pragma once

#include "perception/sensed_state.h"
#include "perception/view.h"

namespace mrose {

/// Whether an ideal sensor of such a view reports a subject: it is in view, with no body before it.
inline bool ideallySeen(const View& view, const SensedState& state) {
    return view.holds(state.range, state.bearing) && state.clearance > 0;
}

}  // namespace mrose
