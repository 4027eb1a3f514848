#pragma once

#include <QLabel>

namespace mrose {

/// Words that always take the room of so many lines: what does not fit is left out at the end, and then all of it is
/// the tool tip.
class ElidingText final : public QLabel {
    Q_OBJECT

public:
    explicit ElidingText(int lines, QWidget* parent = nullptr);

    void setLines(int lines);
    /// What is to be seen of the text, with its line ends.
    QString shownText() const;
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;
    bool hasHeightForWidth() const override { return false; }

protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    int lines_;
};

}  // namespace mrose
