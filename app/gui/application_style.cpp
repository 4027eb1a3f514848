#include "application_style.h"

#include <QPainter>
#include <QStyleOption>

#include "widgets/theme.h"

namespace mrose::gui {

QColor checkBoxFrame(const QPalette& palette) {
    constexpr double leastContrast = 3.2;
    return seenOn(palette.color(QPalette::Window), palette.color(QPalette::Mid), leastContrast);
}

void ApplicationStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                                     const QWidget* widget) const {
    const auto* const header = qstyleoption_cast<const QStyleOptionHeader*>(option);
    if (element == PE_IndicatorHeaderArrow && header != nullptr) {
        QStyleOptionHeader turned = *header;
        turned.sortIndicator = header->sortIndicator == QStyleOptionHeader::SortUp     ? QStyleOptionHeader::SortDown
                               : header->sortIndicator == QStyleOptionHeader::SortDown ? QStyleOptionHeader::SortUp
                                                                                       : header->sortIndicator;
        return QProxyStyle::drawPrimitive(element, &turned, painter, widget);
    }
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    const bool byKeys = (option->state & State_HasFocus) && (option->state & State_KeyboardFocusChange);
    if (element != PE_IndicatorCheckBox || byKeys || !(option->state & State_Enabled)) return;
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing, false);
    painter->setPen(checkBoxFrame(option->palette));
    painter->setBrush(Qt::NoBrush);
    painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
    painter->restore();
}

}  // namespace mrose::gui
