#pragma once

class QWidget;

namespace mrose {
class MessageBar;
}

namespace mrose::gui {

class Actions;
class Session;
class StatusLine;
class WindowMemory;

/// What all parts of a window may use: the run's thread, what can be done, where something is said, what is kept from
/// one start to the next.
struct Frame {
    QWidget& window;  ///< above which dialogues open
    Session& session;
    Actions& actions;
    MessageBar& messages;
    StatusLine& status;
    WindowMemory& memory;
};

}  // namespace mrose::gui
