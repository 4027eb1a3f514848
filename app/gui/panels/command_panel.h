#pragma once

#include <QWidget>

#include "session/session.h"
#include "widgets/theme.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace mrose::gui {

/// The command that the selected robot decided last, to be changed: which begins a branch at that decision.
class CommandPanel final : public QWidget {
    Q_OBJECT

public:
    explicit CommandPanel(QWidget* parent = nullptr);

    void setShown(const Shown& shown);
    void setRobot(std::optional<std::size_t> body);
    /// To type in. What is missing for that; empty: nothing is.
    QString edit();
    /// The values of the decision again, in place of what was typed.
    void takeBack();
    /// As the button does, where the run stands. What is missing for that; empty: nothing is.
    QString apply();

    QSize sizeHint() const override { return {230, 210}; }

signals:
    void branchRequested(const Edit& edit);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QString missing() const;  ///< for a command to be changed
    void refresh();
    void fill();
    /// The decision of the selected robot that is shown; null where there is none.
    const RobotInsight* decision() const;

    Shown shown_;
    std::optional<std::size_t> body_;
    std::int64_t filledFrom_ = -2;  ///< tick of the decision whose values stand in the fields
    std::optional<std::size_t> filledFor_;
    QLabel* what_;
    QDoubleSpinBox *v_, *w_, *power_;
    QComboBox* kick_;
    QSpinBox* periods_;
    QPushButton* apply_;
};

}  // namespace mrose::gui
