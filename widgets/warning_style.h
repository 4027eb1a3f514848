#pragma once

#include <QString>

class QWidget;

namespace mrose {

/// A style sheet by which a label in a widget speaks in the colour of warnings, legible on the widget's ground.
QString warningStyle(const QWidget& widget);

}  // namespace mrose
