#pragma once

#include <QIcon>

#include "widgets/theme.h"

namespace mrose {

/// Drawn here, in the theme's colours, so that they are the same on every desktop.
enum class Icon { play, pause, tickForward, tickBack, periodForward, periodBack, toStart, toEnd, reset, fit, follow };
QIcon icon(Icon which, const Theme& theme);

}  // namespace mrose
