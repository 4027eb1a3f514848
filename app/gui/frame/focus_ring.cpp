#include "frame/focus_ring.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QEvent>
#include <QPainter>
#include <QToolBar>

#include "widgets/field_view.h"
#include "widgets/timeline_bar.h"

namespace mrose::gui {

/// Beside what it is about, not in it: pictures of a field alone are without it.
class FocusRing::Ring final : public QWidget {
public:
    Ring(const QWidget& about, const QColor& colour) : QWidget(about.parentWidget()), colour_(colour) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        setFocusPolicy(Qt::NoFocus);
        follow(about);
    }
    void follow(const QWidget& about) {
        setGeometry(about.geometry());
        raise();
        setVisible(!about.isHidden());
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        constexpr double width = 2;
        QPainter painter(this);
        painter.setPen(QPen(colour_, width, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
        painter.drawRect(QRectF(rect()).adjusted(width / 2, width / 2, -width / 2, -width / 2));
    }

private:
    QColor colour_;
};

FocusRing::FocusRing(QWidget& window) : QObject(&window), window_(window) {
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) { follow(now); });
}

QWidget* FocusRing::shownAbout() const { return ring_ ? target_.data() : nullptr; }

void FocusRing::setTheme(const Theme& theme) {
    theme_ = theme;
    // What is selected in a list that the keys do not go to.
    QPalette quiet = QApplication::palette();
    quiet.setColor(QPalette::Highlight, mixed(theme.panel, theme.accent, theme.dark ? 0.22 : 0.14));
    quiet.setColor(QPalette::HighlightedText, theme.text);
    const QPalette full = QApplication::palette();
    QApplication::setPalette(quiet, "QAbstractItemView");
    QApplication::setPalette(full, "QComboBoxListView");
    follow(QApplication::focusWidget());
}

void FocusRing::follow(QWidget* now) {
    if (target_) {
        target_->removeEventFilter(this);
        if (qobject_cast<QAbstractItemView*>(target_)) target_->setPalette(QPalette());
    }
    delete ring_;
    auto* list = qobject_cast<QAbstractItemView*>(now);
    const bool inBar = now != nullptr && qobject_cast<QToolBar*>(now->parentWidget()) != nullptr;
    const bool ringed = now != nullptr && now->window() == &window_ &&
                        (list || inBar || qobject_cast<FieldView*>(now) || qobject_cast<TimelineBar*>(now));
    target_ = ringed ? now : nullptr;
    if (!ringed) return;
    if (list != nullptr) {
        QPalette full = list->palette();
        full.setColor(QPalette::Highlight, QApplication::palette().color(QPalette::Highlight));
        full.setColor(QPalette::HighlightedText, QApplication::palette().color(QPalette::HighlightedText));
        list->setPalette(full);
    }
    ring_ = new Ring(*now, theme_.accent);
    now->installEventFilter(this);
}

bool FocusRing::eventFilter(QObject* watched, QEvent* event) {
    const QEvent::Type type = event->type();
    const bool moved = type == QEvent::Resize || type == QEvent::Move || type == QEvent::Show || type == QEvent::Hide;
    if (moved && ring_ && watched == target_) ring_->follow(*target_);
    return QObject::eventFilter(watched, event);
}

}  // namespace mrose::gui
