#pragma once

#include <QApplication>
#include <QScrollArea>
#include <QScrollBar>
#include <algorithm>

namespace mrose::gui {

/// A panel that is scrolled up and down where it takes more room than there is, so that no panel makes the window
/// larger than its screen. What the keys go to is in sight.
class ShrinkingArea final : public QScrollArea {
public:
    explicit ShrinkingArea(QWidget* content) {
        setWidget(content);
        setWidgetResizable(true);
        setFrameShape(QFrame::NoFrame);
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        setFocusPolicy(Qt::NoFocus);
        connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
            if (now != nullptr && widget()->isAncestorOf(now)) ensureWidgetVisible(now, 0, aboutFocus);
        });
    }

    QSize sizeHint() const override { return widget()->sizeHint().expandedTo(minimumSizeHint()); }
    QSize minimumSizeHint() const override {
        const QSize needed = widget()->minimumSizeHint().expandedTo(widget()->minimumSize());
        return {needed.width() + verticalScrollBar()->sizeHint().width(), std::min(needed.height(), leastHeight)};
    }

private:
    static constexpr int leastHeight = 64, aboutFocus = 6;  // pixels
};

}  // namespace mrose::gui
