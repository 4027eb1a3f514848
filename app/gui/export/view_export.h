#pragma once

#include <QPainter>
#include <QSize>
#include <QString>
#include <functional>

#include "io/error.h"

class QWidget;

namespace mrose::gui {

/// What is to be drawn into a file, in units of which `perInch` are an inch, as on the screen that it comes from.
struct Picture {
    QSize size;
    int perInch = 96;
    QString title;
    std::function<void(QPainter&)> paint;
};

/// Error unless a picture could be written there: another extension than .png, .svg or .pdf; what the system says.
Expected<void> checkPicture(const QString& path);

/// A widget as it is shown, as writePicture() does it, a pixel for a unit.
Expected<void> writeWidget(QWidget& widget, const QString& path);

/// Writes PNG (of so many pixels a unit), SVG or PDF, as the extension says, wholly or not at all. Error: as
/// checkPicture().
Expected<void> writePicture(const Picture& picture, const QString& path, int pixels = 2);

}  // namespace mrose::gui
