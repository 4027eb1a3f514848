#pragma once

#include <QWidget>

#include "course_list.h"
#include "overlay.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QToolButton;
class QTreeView;

namespace mrose::gui {

/// What an overlay is about: the log, where the simulated robots start, how far they are off, and the list of courses
/// in which the worst comes first.
class OverlayPanel final : public QWidget {
    Q_OBJECT

public:
    explicit OverlayPanel(Overlay& overlay, QWidget* parent = nullptr);

    void setTheme(const Theme& theme);
    QTreeView& list() const { return *list_; }
    /// The robot whose figures are shown; the field's selection.
    void setRobot(std::optional<std::size_t> robot);

    QSize sizeHint() const override { return {380, 640}; }

private:
    QWidget* makeHead();
    QWidget* makePlan();
    QWidget* makeProgress();
    void makeList();
    void refresh();
    void refreshFigures();
    void refreshShown();
    void applyPlan();
    void openLine(const QModelIndex& index);
    std::optional<std::size_t> robotShown() const;

    Overlay& overlay_;
    CourseList* courses_;
    QLabel *log_, *about_, *figures_, *shown_;
    QComboBox* cut_;
    QDoubleSpinBox *start_, *length_;
    QLabel* startLabel_;
    QCheckBox* restarts_;
    QWidget* progress_;
    QProgressBar* bar_;
    QTreeView* list_;
    std::optional<std::size_t> robot_;  ///< in LogWorld::robots()
    std::size_t listed_ = 0;            ///< lines, when the list was filled
    OverlayWorldPointer listedOf_;
    bool filling_ = false;
    Theme theme_ = Theme::light();
};

}  // namespace mrose::gui
