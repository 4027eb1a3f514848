#pragma once

#include <QApplication>
#include <QScrollArea>
#include <QScrollBar>
#include <algorithm>

namespace mrose::gui {

/// A panel that is scrolled where it takes more room than there is, so that no panel makes the window larger than its
/// screen, or the field too small. What the keys go to is in sight.
class ShrinkingArea final : public QScrollArea {
public:
    explicit ShrinkingArea(QWidget* content) {
        setWidget(content);
        setWidgetResizable(true);
        setFrameShape(QFrame::NoFrame);
        setFocusPolicy(Qt::NoFocus);
        connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
            if (now != nullptr && widget()->isAncestorOf(now)) ensureWidgetVisible(now, 0, aboutFocus);
        });
    }

    QSize sizeHint() const override { return widget()->sizeHint().expandedTo(minimumSizeHint()); }
    QSize minimumSizeHint() const override {
        return {std::min(contentWidth(), leastWidth + besideContent()), std::min(needed().height(), leastHeight)};
    }
    /// With which nothing is scrolled to the side.
    int contentWidth() const { return needed().width() + besideContent(); }

private:
    QSize needed() const { return widget()->minimumSizeHint().expandedTo(widget()->minimumSize()); }
    /// The bar to scroll up and down by, where it is needed.
    int besideContent() const { return needed().height() > height() ? verticalScrollBar()->sizeHint().width() : 0; }

    static constexpr int leastWidth = 250, leastHeight = 64, aboutFocus = 6;  // pixels
};

}  // namespace mrose::gui
