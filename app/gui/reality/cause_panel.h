#pragma once

#include <QWidget>

#include "reality/overlay.h"
#include "widgets/theme.h"

class QBoxLayout;
class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QToolButton;
class QTreeWidget;

namespace mrose {
class ElidingText;
}

namespace mrose::gui {

/// The shown rollout of an overlay: how far its robot is off, where it first leaves the real trajectory, and why. A
/// click on a cause lays its re-run beside.
class CausePanel final : public QWidget {
    Q_OBJECT

public:
    explicit CausePanel(Overlay& overlay, QWidget* parent = nullptr);

    void refresh();
    void setLow(bool low);        ///< where there is little room in height, fewer causes are seen at once
    void offer(QAction& speeds);  ///< shown beside the divergence
    QTreeWidget& causes() const { return *causes_; }
    QString text() const;  ///< what it says, plain

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void fitLines();
    QWidget* makeBound();
    void makeCauses();
    void applyBound();
    void refreshCauses();
    QString likely() const;

    Overlay& overlay_;
    ElidingText *rollout_, *divergence_, *onset_, *cause_;
    QToolButton *goThere_, *speeds_;
    QDoubleSpinBox *position_, *heading_;
    QCheckBox* learned_;
    QLabel* inForce_;  ///< the bound that grows with the way
    QTreeWidget* causes_;
    QWidget* why_;                          ///< it leaves
    std::weak_ptr<const PlayedLog> whyOf_;  ///< the log of which a rollout that leaves has been shown
    QBoxLayout* boundLines_ = nullptr;
    bool low_ = false, filling_ = false;
};

}  // namespace mrose::gui
