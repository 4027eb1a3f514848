#pragma once

#include <QHelpEvent>
#include <QToolTip>
#include <QWidget>

namespace mrose {

/// Shows what a widget says at the place of a tool tip's event, by `textAt` of its pixel from the left. False: the
/// event is another one.
template <class TextAt>
bool showToolTip(QEvent* event, QWidget& of, const TextAt& textAt) {
    if (event->type() != QEvent::ToolTip) return false;
    const auto* help = static_cast<QHelpEvent*>(event);
    QToolTip::showText(help->globalPos(), textAt(help->pos().x()), &of);
    return true;
}

}  // namespace mrose
