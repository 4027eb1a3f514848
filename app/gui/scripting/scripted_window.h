#pragma once

#include "export/exports.h"
#include "frame/window_frame.h"

namespace mrose::gui {

class ErrorPlot;
class OverlayPanel;
class TimeBar;

/// What a script works with beside the window's actions.
struct ScriptedWindow {
    const WindowFrame& frame;
    FieldView& field;
    PlotPanel& plots;
    ErrorPlot& errors;
    Overlay& overlay;
    OverlayPanel& reality;
    TimeBar& time;
    const Exports& exports;
};

}  // namespace mrose::gui
