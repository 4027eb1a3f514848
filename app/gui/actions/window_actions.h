#pragma once

namespace mrose::gui {

class MainWindow;

// The window's actions, a function for each menu. Called once, in the order of the menu bar.
void addFileActions(MainWindow& window);
void addOpenLog(MainWindow& window);  ///< beside Open
void addOverlayActions(MainWindow& window);
void addEditActions(MainWindow& window);
void addTimeActions(MainWindow& window);
void addBranchActions(MainWindow& window);
void addBreakActions(MainWindow& window);
void addViewActions(MainWindow& window);
void addLayerActions(MainWindow& window);
void addPlotActions(MainWindow& window);
void addExportActions(MainWindow& window);
void addHelpActions(MainWindow& window);

/// At a start without arguments: what to try first, unless the user has closed it before.
void showFirstSteps(MainWindow& window);

}  // namespace mrose::gui
