#pragma once

#include <QDialog>
#include <vector>

#include "frame/actions.h"
#include "widgets/theme.h"

class QGridLayout;
class QLineEdit;
class QScrollArea;

namespace mrose::gui {

/// Keys or a gesture of the mouse, and what they do.
struct Shortcut {
    QString keys, does, tip;
};
struct ShortcutGroup {
    QString title;
    std::vector<Shortcut> shortcuts;
};
/// Of all menus, and of the mouse.
std::vector<ShortcutGroup> shortcutGroups(const Actions& actions);

/// As text, a line each.
QString shortcutText(const std::vector<ShortcutGroup>& groups);

/// All shortcuts in columns, with a field to search in. Not modal: it can stay open beside the work.
class ShortcutSheet final : public QDialog {
    Q_OBJECT

public:
    explicit ShortcutSheet(const Actions& actions, QWidget* parent);

    /// Shows those with all of the words in them.
    void search(const QString& words);

protected:
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void fill();
    int fittingColumns(int width) const;
    QWidget* block(const ShortcutGroup& group);

    const Actions& actions_;
    QString words_;
    int blockWidth_ = 0;  ///< of the widest, pixels
    int columns_ = 0;
    QLineEdit* line_;
    QScrollArea* area_;
};

}  // namespace mrose::gui
