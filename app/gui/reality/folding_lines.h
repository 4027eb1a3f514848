#pragma once

#include <QBoxLayout>
#include <QWidget>

namespace mrose::gui {

/// Lays the lines of a widget beside each other, or again below each other. Beside each other they ask for no width,
/// so that their panel can be made narrow again.
inline void layBeside(QBoxLayout& lines, bool beside) {
    lines.setDirection(beside ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    QWidget* const widget = lines.parentWidget();
    QSizePolicy policy = widget->sizePolicy();
    policy.setHorizontalPolicy(beside ? QSizePolicy::Ignored : QSizePolicy::Preferred);
    widget->setSizePolicy(policy);
}

}  // namespace mrose::gui
