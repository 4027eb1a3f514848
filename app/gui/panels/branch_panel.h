#pragma once

#include <QWidget>

#include "session/session.h"
#include "widgets/theme.h"

class QAction;
class QLabel;
class QTreeWidget;
class QTreeWidgetItem;

namespace mrose::gui {

/// All branches of a run as a tree, and how the shown one differs from the one beside it at this tick.
class BranchPanel final : public QWidget {
    Q_OBJECT

public:
    explicit BranchPanel(QWidget* parent = nullptr);

    void setShown(const Shown& shown);
    void setTheme(const Theme& theme);
    /// The one that the keyboard is on.
    std::optional<std::uint32_t> current() const;
    /// Lets its name be typed.
    void editName();

    QSize sizeHint() const override { return {230, 420}; }

signals:
    void branchRequested(std::uint32_t branch);
    void besideRequested(std::uint32_t branch);
    void removalRequested(std::uint32_t branch);
    void renamed(std::uint32_t branch, const QString& name);

private:
    void rebuild(const Shown& shown);
    void refresh(const Shown& shown);
    void compare(const Shown& shown);
    /// What can be done with the one that the keyboard is on.
    void enableOffers();
    static QString nameOf(const Shown& shown, std::uint32_t branch);

    QTreeWidget* tree_;
    QLabel* heading_;
    QTreeWidget* differences_;
    QAction *show_ = nullptr, *compare_ = nullptr, *rename_ = nullptr, *delete_ = nullptr;
    std::vector<QTreeWidgetItem*> items_;  ///< of each branch
    std::vector<std::uint32_t> parents_;   ///< as the tree shows them
    std::optional<Shown> shown_;
    std::uint32_t current_ = noBody;  ///< shown as chosen
    bool filling_ = false;
    Theme theme_ = Theme::light();
};

}  // namespace mrose::gui
