#pragma once

namespace mrose::gui {

/// Qt's warnings go to standard error as "mrose-gui: ...", without those that mean nothing where there is no desktop.
/// From now on until windowSystemFound(), what Qt says of a display that it cannot reach is one line and exit status 1
/// instead of an abort.
void handleQtMessages();
void windowSystemFound();

}  // namespace mrose::gui
