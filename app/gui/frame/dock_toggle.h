#pragma once

class QDockWidget;

namespace mrose::gui {

/// A panel that is behind another comes to the front when it is asked for, instead of going away.
void raiseInsteadOfHiding(QDockWidget& dock);

}  // namespace mrose::gui
