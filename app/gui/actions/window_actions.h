#pragma once

#include <functional>

#include "export/exports.h"
#include "frame/frame.h"

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
class OverlayPanel;
class SideView;
class TimeBar;

// The window's actions, a function for each menu, with what they act upon. Called once, in the order of the menu bar.
void addFileActions(const Frame& frame, FieldView& field, WindowFiles& files, Overlay& overlay, WorkProgress& progress);
void addOverlayActions(const Frame& frame, FieldView& field, Overlay& overlay, OverlayPanel& panel,
                       RolloutStrip& strip);
void addEditActions(const Frame& frame, FieldView& field);
void addTimeActions(const Frame& frame, const FieldView& field, TimelineBar& timeline, Overlay& overlay, TimeBar& bar);
void addBranchActions(const Frame& frame, SideView& view, BranchPanel& branches, CommandPanel& command);
void addBreakActions(const Frame& frame, const FieldView& field, BreakpointPanel& panel, Overlay& overlay);
void addViewActions(const Frame& frame, FieldView& field, const std::function<void(const Theme&)>& setTheme);
void addLayerActions(const Frame& frame, FieldView& field);
void addPlotActions(const Frame& frame, FieldView& field, PlotPanel& plots, Inspector& inspector, Overlay& overlay,
                    OverlayPanel& panel, ErrorPlot& errorPlot);
void addExportActions(const Exports& exports);
void addHelpActions(const Frame& frame, FieldView& field, PlotPanel& plots, CommandPanel& command, Overlay& overlay);

/// At a start without arguments: what to try first, unless the user has closed it before.
void showFirstSteps(Actions& actions);

}  // namespace mrose::gui
