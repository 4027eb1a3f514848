#pragma once

#include <QProxyStyle>

namespace mrose::gui {

/// Fusion, but for what it draws too faintly on a dark ground, for scroll bars, and for the arrow of a sorted column,
/// which points down where the largest comes first.
class ApplicationStyle final : public QProxyStyle {
    Q_OBJECT

public:
    ApplicationStyle() : QProxyStyle("Fusion") {}

    void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                       const QWidget* widget) const override;
    void drawComplexControl(ComplexControl control, const QStyleOptionComplex* option, QPainter* painter,
                            const QWidget* widget) const override;
};

/// The frame of a check box on a ground: 3 to 1, as WCAG 2.1 asks for.
QColor checkBoxFrame(const QPalette& palette);
/// Of a scroll bar: as far from its groove.
QColor scrollBarHandle(const QPalette& palette);

}  // namespace mrose::gui
