#include "widgets/warning_style.h"

#include <QWidget>

#include "widgets/theme.h"

namespace mrose {

QString warningStyle(const QWidget& widget) {
    constexpr double leastContrast = 4.5;
    const QColor ground = widget.palette().color(QPalette::Window);
    return "color: " + seenOn(ground, Theme::light().warning, leastContrast).name();
}

}  // namespace mrose
