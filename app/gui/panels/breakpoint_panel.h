#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "debug/breakpoints.h"
#include "debug/shown.h"
#include "widgets/theme.h"

class QLabel;
class QLineEdit;
class QListWidget;
class QListWidgetItem;
class QMenu;
class QToolButton;

namespace mrose::gui {

/// All breakpoints with what is known of them, and a line in which conditions are typed.
class BreakpointPanel final : public QWidget {
    Q_OBJECT

public:
    explicit BreakpointPanel(QWidget* parent = nullptr);

    void setShown(const Shown& shown);
    void setTheme(const Theme& theme);
    /// Offered beside the line: what can be added without typing.
    void setOffers(QMenu* menu);
    /// Of its context menu.
    void offer(QAction* action);

    /// The one that the keyboard is on.
    std::optional<Breakpoint> current() const;
    /// To the line in which a condition is typed.
    void edit();
    /// Asks for a breakpoint of that text. Error: it does not fit what is shown.
    Expected<void> add(const QString& text);

    QSize sizeHint() const override { return {230, 190}; }

signals:
    void added(const mrose::Breakpoint& breakpoint);
    void changed(const mrose::Breakpoint& breakpoint);
    void removed(std::uint32_t id);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void refresh(QListWidgetItem& item, const BreakpointState& state);
    void itemChanged(const QListWidgetItem& item);
    void check();
    void reply(const QString& text, bool wrong);

    QListWidget* list_;
    QLineEdit* line_;
    QToolButton* offers_;
    QLabel* reply_;
    BranchSetupPointer setup_;
    RealityPointer reality_;
    std::vector<BreakpointState> states_;
    Theme theme_ = Theme::light();
    bool filling_ = false;
};

}  // namespace mrose::gui
