#include "frame/quiet_message.h"

#include <QEvent>
#include <algorithm>

namespace mrose::gui {
namespace {

constexpr int shownFor = 6000;                      // ms
constexpr int aboveTheEdge = 48, besideEdges = 12;  // pixels: of the scale bar it stays clear

}  // namespace

QuietMessage::QuietMessage(QWidget& over) : QLabel(&over) {
    setObjectName("quiet_message");
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setTextFormat(Qt::PlainText);
    setWordWrap(true);
    setAlignment(Qt::AlignCenter);
    setMargin(6);
    hide();
    end_.setSingleShot(true);
    end_.setInterval(shownFor);
    connect(&end_, &QTimer::timeout, this, &QWidget::hide);
    over.installEventFilter(this);
}

void QuietMessage::say(const QString& words) {
    setText(words);
    place();
    raise();
    show();
    end_.start();
}

/// As wide as its text, in the middle; in several lines where there is no room. Other things over the view it is
/// beside, or else above.
void QuietMessage::place() {
    const int room = std::max(60, parentWidget()->width() - 2 * besideEdges);
    const int wide = std::min(room, fontMetrics().horizontalAdvance(text()) + 2 * margin() + 12);
    const int high = heightForWidth(wide);
    QRect place((parentWidget()->width() - wide) / 2, parentWidget()->height() - aboveTheEdge - high, wide, high);
    for (const QWidget* other : parentWidget()->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
        if (other == this || other->isHidden() || !other->geometry().intersects(place)) continue;
        const int left = other->x() - besideEdges - wide;
        if (left >= besideEdges)
            place.moveLeft(std::min(left, place.left()));
        else
            place.moveTop(other->y() - besideEdges - high);
    }
    setGeometry(place);
}

void QuietMessage::setTheme(const Theme& theme) {
    setStyleSheet(QString("background:%1;color:%2;border:1px solid %3;border-radius:4px")
                      .arg(theme.panel.name(), theme.text.name(), theme.line.name()));
}

bool QuietMessage::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible()) place();
    return QLabel::eventFilter(watched, event);
}

}  // namespace mrose::gui
