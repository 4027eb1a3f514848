#pragma once

#include "reality/overlay.h"
#include "widgets/course_strip.h"

namespace mrose::gui {

/// The take of the shown course, with the errors of the robot that is asked about.
CourseStrip::Content stripOf(const Overlay& overlay);

}  // namespace mrose::gui
