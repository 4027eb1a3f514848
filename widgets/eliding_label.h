#pragma once

#include <QLabel>

namespace mrose {

/// A line of text that takes no more room than there is: what does not fit is left out in its middle, and then all of
/// it is the tool tip.
class ElidingLabel : public QLabel {
    Q_OBJECT

public:
    explicit ElidingLabel(QWidget* parent = nullptr);

    /// What is to be seen of the text.
    QString shownText() const;
    QSize minimumSizeHint() const override;

protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
};

}  // namespace mrose
