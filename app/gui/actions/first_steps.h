#pragma once

#include <QFrame>
#include <vector>

#include "frame/window_frame.h"

class QLabel;
class QToolButton;

namespace mrose {
class FieldView;
}

namespace mrose::gui {

class CommandPanel;
class PlotPanel;

/// What to try first, ticked off as it is done: a card in a corner of the field view, over what the fitted field leaves
/// free there. Where that is too little, or it were much of the view, it folds to a button, which opens it over the
/// field if it fits in there. Its user may close it, and the menu brings it back.
class FirstSteps final : public QFrame {
    Q_OBJECT

public:
    FirstSteps(const WindowFrame& frame, FieldView& field, PlotPanel& plots, CommandPanel& command);

    struct Step {
        QString keys, text;
        bool done = false;
    };
    const std::vector<Step>& steps() const { return steps_; }
    void setVisible(bool visible) override;
    bool folded() const;

signals:
    void closeRequested();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void add(const Step& step, std::initializer_list<const char*> actions);
    void tick(std::size_t step);
    void place();
    QRect corner(const QSize& size) const;

    const WindowFrame& frame_;
    FieldView& field_;
    PlotPanel& plots_;
    std::vector<Step> steps_;
    std::vector<QLabel*> marks_;
    QToolButton* button_;  ///< in its place where it is folded
    std::size_t branches_ = 1;
    bool wanted_ = false, opened_ = false, couldRedo_ = false;
};

}  // namespace mrose::gui
