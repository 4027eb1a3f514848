#pragma once

#include "frame/window_frame.h"

namespace mrose {
class FieldView;
}

namespace mrose::gui {

class BackgroundWork;
class Overlay;
class PlotPanel;
class WindowFiles;
class WorkProgress;

/// What exports are made of, and who carries them out and reports them.
struct Exports {
    const WindowFrame& frame;
    FieldView& field;
    PlotPanel& plots;
    WindowFiles& files;
    Overlay& overlay;
    BackgroundWork& background;
    WorkProgress& progress;
};

}  // namespace mrose::gui
