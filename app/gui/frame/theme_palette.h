#pragma once

#include <QPalette>

#include "widgets/theme.h"

namespace mrose::gui {

/// The colours of a theme for what is not drawn by mrose itself.
QPalette paletteOf(const Theme& theme);

}  // namespace mrose::gui
