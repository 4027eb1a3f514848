#pragma once

#include <QWidget>

#include "reality/cause_panel.h"
#include "reality/overlay.h"
#include "reality/rollout_table.h"

class QBoxLayout;
class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QMenu;
class QProgressBar;
class QToolButton;
class QTreeWidget;

namespace mrose {
class ElidingText;
}

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

protected:
    void resizeEvent(QResizeEvent* event) override;

signals:
    void modelFileWanted();
    void modelRemovalWanted();  ///< of the list's current one

private:
    QWidget* makeHead();
    QWidget* makePlan();
    QWidget* makeProgress();
    void refresh();
    QWidget* makeModels();
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
    QLabel* log_;
    ElidingText *about_, *counts_;
    CausePanel* causes_;
    QBoxLayout* planLines_ = nullptr;
    QComboBox* cut_;
    QDoubleSpinBox *start_, *length_;
    QLabel* startLabel_;
    QCheckBox* restarts_;
    QWidget* progress_;
    QToolButton* stop_;
    QProgressBar* bar_;
    QTreeWidget* models_;
    QComboBox* figures_;  ///< whose the models' are
    RolloutTable* list_;
    std::uint64_t listed_ = 0;                                     ///< Overlay::rowsVersion() of the list
    std::optional<std::pair<std::size_t, std::size_t>> selected_;  ///< rollout and robot
    bool filling_ = false;
    Theme theme_ = Theme::light();
};

}  // namespace mrose::gui
