#pragma once

#include <QWidget>
#include <array>

#include "reality/cause_panel.h"
#include "reality/overlay.h"
#include "reality/rollout_list.h"

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

/// What an overlay is about: the log, where the simulated robots start, how far they are off, and the list of rollouts
/// in which the worst comes first.
class OverlayPanel final : public QWidget {
    Q_OBJECT

public:
    explicit OverlayPanel(Overlay& overlay, QWidget* parent = nullptr);

    void setTheme(const Theme& theme);
    QTreeView& list() const { return *list_; }
    QTreeWidget& models() const { return *models_; }
    RolloutList* rollouts() const { return rollouts_; }
    void openLine(const QModelIndex& index);  ///< the rollout of a line of the list
    CausePanel& causes() const { return *causes_; }

    QSize sizeHint() const override { return {400, 600}; }

signals:
    void modelFileWanted();
    void modelRemovalWanted();  ///< of the list's current one

private:
    QWidget* makeHead();
    QWidget* makePlan();
    QWidget* makeProgress();
    void makeList();
    void refresh();
    QWidget* makeModels();
    void fitColumns();
    void fillModelMenu(QMenu& menu);
    void refreshModels();
    bool showsEvaluated() const;
    void refreshList();
    void fillList();
    void select(std::size_t rollout, std::size_t robot);
    void selectShown();
    void applyPlan();

    Overlay& overlay_;
    RolloutList* rollouts_;
    QLabel *log_, *about_;
    CausePanel* causes_;
    QComboBox* cut_;
    QDoubleSpinBox *start_, *length_;
    QLabel* startLabel_;
    QCheckBox* restarts_;
    QWidget* progress_;
    QToolButton* stop_;
    QProgressBar* bar_;
    QTreeWidget* models_;
    QComboBox* figures_;  ///< whose the models' are
    QTreeView* list_;
    std::uint64_t listed_ = 0;                                     ///< Overlay::rowsVersion() of the list
    std::size_t fitted_ = 0;                                       ///< rows that the columns are wide enough for
    std::array<int, RolloutList::columns> widths_{};               ///< pixels: of what they show
    std::optional<std::pair<std::size_t, std::size_t>> selected_;  ///< rollout and robot
    bool filling_ = false;
    Theme theme_ = Theme::light();
};

}  // namespace mrose::gui
