#pragma once

#include <functional>

#include "export/exports.h"
#include "frame/window_frame.h"

namespace mrose {
class FieldView;
class Inspector;
class RolloutStrip;
class TimelineBar;
struct Theme;
}  // namespace mrose

namespace mrose::gui {

class BranchPanel;
class BreakpointPanel;
class CommandPanel;
class ErrorPlot;
class FieldBands;
class OverlayPanel;
class SideView;
class TimeBar;

// The window's actions, a function for each menu, with what they act upon. Called once, in the order of the menu bar.
void addFileActions(const WindowFrame& frame, FieldView& field, WindowFiles& files, Overlay& overlay,
                    WorkProgress& progress);
void addOverlayActions(const WindowFrame& frame, FieldView& field, Overlay& overlay, OverlayPanel& panel,
                       RolloutStrip& strip);
void addEditActions(const WindowFrame& frame, FieldView& field);
void addTimeActions(const WindowFrame& frame, const FieldView& field, TimelineBar& timeline, Overlay& overlay,
                    TimeBar& bar);
void addBranchActions(const WindowFrame& frame, SideView& view, BranchPanel& branches, CommandPanel& command);
void addBreakActions(const WindowFrame& frame, const FieldView& field, BreakpointPanel& panel, Overlay& overlay);
void addViewActions(const WindowFrame& frame, FieldView& field, const std::function<void(const Theme&)>& setTheme);
void addLayerActions(const WindowFrame& frame, FieldView& field, FieldBands& bands);
void addPlotActions(const WindowFrame& frame, FieldView& field, PlotPanel& plots, Inspector& inspector,
                    Overlay& overlay, OverlayPanel& panel, ErrorPlot& errorPlot);
void addExportActions(const Exports& exports);
void addHelpActions(const WindowFrame& frame, FieldView& field, PlotPanel& plots, CommandPanel& command,
                    Overlay& overlay);

/// At a start without arguments: what to try first, unless the user has closed it before.
void showFirstSteps(Actions& actions);

}  // namespace mrose::gui
