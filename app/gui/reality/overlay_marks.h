#pragma once

namespace mrose::gui {

class MainWindow;
class Overlay;

/// Puts where the shown rollout's robots leave the real one on the window's timeline, and the bound of the robot that
/// is asked about into its plots.
void markDivergences(MainWindow& window, const Overlay& overlay);

}  // namespace mrose::gui
