#pragma once

#include "reality/overlay.h"
#include "widgets/rollout_strip.h"

namespace mrose::gui {

/// The session of the shown rollout, with the errors of the robot that is asked about.
RolloutStrip::Content stripOf(const Overlay& overlay);

}  // namespace mrose::gui
