#include "application_style.h"

#include <QPainter>
#include <QStyleOption>
#include <algorithm>

#include "widgets/theme.h"

namespace mrose::gui {

QColor checkBoxFrame(const QPalette& palette) {
    constexpr double leastContrast = 3.2;
    return seenOn(palette.color(QPalette::Window), palette.color(QPalette::Mid), leastContrast);
}

QColor scrollBarHandle(const QPalette& palette) {
    return mixed(palette.color(QPalette::Window), palette.color(QPalette::WindowText), 0.6);
}

/// Its handle is darker than the groove, on dark ground lighter: Fusion draws the groove as the more solid of the two.
void ApplicationStyle::drawComplexControl(ComplexControl control, const QStyleOptionComplex* option, QPainter* painter,
                                          const QWidget* widget) const {
    const auto* const bar = qstyleoption_cast<const QStyleOptionSlider*>(option);
    if (control != CC_ScrollBar || bar == nullptr)
        return QProxyStyle::drawComplexControl(control, option, painter, widget);
    constexpr int aside = 3;           // pixels, of the handle in its groove
    constexpr double pointedAt = 0.4;  // nearer to the text's colour
    const QColor text = bar->palette.color(QPalette::WindowText), handle = scrollBarHandle(bar->palette);
    painter->fillRect(bar->rect, mixed(bar->palette.color(QPalette::Window), text, 0.06));
    for (const SubControl button : {SC_ScrollBarAddLine, SC_ScrollBarSubLine}) {
        const bool flat = bar->orientation == Qt::Horizontal, on = button == SC_ScrollBarAddLine;
        QStyleOption arrow(*option);
        arrow.rect = subControlRect(control, bar, button, widget).adjusted(aside, aside, -aside, -aside);
        arrow.palette.setColor(QPalette::WindowText, handle);
        drawPrimitive(flat
                          ? (on != (bar->direction == Qt::RightToLeft) ? PE_IndicatorArrowRight : PE_IndicatorArrowLeft)
                      : on ? PE_IndicatorArrowDown
                           : PE_IndicatorArrowUp,
                      &arrow, painter, widget);
    }
    if (bar->maximum <= bar->minimum) return;
    const QRectF room = QRectF(subControlRect(control, bar, SC_ScrollBarSlider, widget));
    const double thick = std::min(room.width(), room.height());
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(Qt::NoPen);
    painter->setBrush(mixed(handle, text, (bar->activeSubControls & SC_ScrollBarSlider) != 0 ? pointedAt : 0));
    painter->drawRoundedRect(
        bar->orientation == Qt::Horizontal ? room.adjusted(0, aside, 0, -aside) : room.adjusted(aside, 0, -aside, 0),
        thick / 2 - aside, thick / 2 - aside);
    painter->restore();
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
