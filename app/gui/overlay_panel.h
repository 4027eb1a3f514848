#pragma once

#include <QWidget>

#include "cause_panel.h"
#include "course_list.h"
#include "overlay.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QMenu;
class QProgressBar;
class QToolButton;
class QTreeView;
class QTreeWidget;

namespace mrose::gui {

/// What an overlay is about: the log, where the simulated robots start, how far they are off, and the list of courses
/// in which the worst comes first.
class OverlayPanel final : public QWidget {
    Q_OBJECT

public:
    explicit OverlayPanel(Overlay& overlay, QWidget* parent = nullptr);

    void setTheme(const Theme& theme);
    QTreeView& list() const { return *list_; }
    QTreeWidget& models() const { return *models_; }
    CourseList* courses() const { return courses_; }
    void openLine(const QModelIndex& index);  ///< the course of a line of the list
    CausePanel& causes() const { return *causes_; }

    QSize sizeHint() const override { return {380, 640}; }

signals:
    void modelFileWanted();

private:
    QWidget* makeHead();
    QWidget* makePlan();
    QWidget* makeProgress();
    void makeList();
    void refresh();
    QWidget* makeModels();
    void fillModelMenu(QMenu& menu);
    void refreshModels();
    void selectShown();
    void applyPlan();

    Overlay& overlay_;
    CourseList* courses_;
    QLabel *log_, *about_;
    CausePanel* causes_;
    QComboBox* cut_;
    QDoubleSpinBox *start_, *length_;
    QLabel* startLabel_;
    QCheckBox* restarts_;
    QWidget* progress_;
    QProgressBar* bar_;
    QTreeWidget* models_;
    QCheckBox* free_;
    QTreeView* list_;
    std::size_t listed_ = 0;  ///< lines, when the list was filled
    OverlayWorldPointer listedOf_;
    bool filling_ = false;
    Theme theme_ = Theme::light();
};

}  // namespace mrose::gui
