#include "widgets/eliding_text.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QHelpEvent>
#include <QPainter>
#include <QStyle>
#include <QTextLayout>
#include <QToolTip>

namespace mrose {

ElidingText::ElidingText(int lines, QWidget* parent) : QLabel(parent), lines_(lines) {
    setTextFormat(Qt::PlainText);
    setAlignment(Qt::AlignLeft | Qt::AlignTop);
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    setContextMenuPolicy(Qt::ActionsContextMenu);
    auto* copy = new QAction(tr("&Copy"), this);
    connect(copy, &QAction::triggered, this, [this] { QApplication::clipboard()->setText(text()); });
    addAction(copy);
}

void ElidingText::setLines(int lines) {
    lines_ = lines;
    updateGeometry();
}

QSize ElidingText::sizeHint() const { return {fontMetrics().horizontalAdvance(text()), minimumSizeHint().height()}; }

QSize ElidingText::minimumSizeHint() const {
    return {0, (lines_ - 1) * fontMetrics().lineSpacing() + fontMetrics().height()};
}

QString ElidingText::shownText() const {
    QTextLayout layout(text(), font());
    QStringList shown;
    layout.beginLayout();
    while (true) {
        QTextLine line = layout.createLine();
        if (!line.isValid()) break;
        line.setLineWidth(contentsRect().width());
        const bool last = shown.size() + 1 == lines_;
        const QString rest = text().mid(line.textStart());
        shown << (last ? fontMetrics().elidedText(rest, Qt::ElideRight, contentsRect().width())
                       : rest.left(line.textLength()).trimmed());
        if (last) break;
    }
    layout.endLayout();
    return shown.join('\n');
}

bool ElidingText::event(QEvent* event) {
    const auto isCut = [this] { return shownText().replace('\n', ' ') != text().trimmed(); };
    if (event->type() != QEvent::ToolTip || !toolTip().isEmpty() || !isCut()) return QLabel::event(event);
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text(), this);
    return true;
}

void ElidingText::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    style()->drawItemText(&painter, contentsRect(), static_cast<int>(alignment()), palette(), isEnabled(), shownText(),
                          foregroundRole());
}

}  // namespace mrose
