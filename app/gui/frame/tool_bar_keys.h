#pragma once

#include <QObject>

class QToolBar;

namespace mrose::gui {

/// Makes a tool bar's tools reachable by Tab, and usable there by Space and Return, which elsewhere are the window's
/// own.
class ToolBarKeys final : public QObject {
    Q_OBJECT

public:
    /// Of the tools that are in it now.
    explicit ToolBarKeys(QToolBar& bar);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace mrose::gui
