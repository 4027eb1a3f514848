#pragma once

#include <QImage>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "debug/field_frame.h"
#include "widgets/field_drawing.h"
#include "widgets/field_layers.h"

namespace mrose {

inline const Colour bodyColour{250, 0, 250}, ballColour{0, 250, 250};

/// Discs of 0.3 m radius at those poses, which stand, on a floor of 10 m x 8 m about the origin, and a ball of 0.1 m.
FieldFrame frameOfDiscs(const std::vector<Pose>& robots, const Pose& ball = {4.5, 3.5, 0});

FieldLayers only(std::initializer_list<FieldLayer> layers);

/// The frame as it is painted without a view, 800 x 640 pixels on white.
QImage paintedFrame(const FieldFrame& frame, const ViewTransform& view, const FieldLayers& layers,
                    const FieldFocus& focus = {});

/// The widget as it paints itself on a screen of so many device pixels a pixel.
QImage rendered(QWidget& widget, double ratio = 1);

struct Blob {
    QPointF middle;  ///< device pixels
    int pixels = 0;
};
/// Of the pixels that are nearly of a colour, `near` in each channel.
Blob blobOf(const QImage& image, const QColor& colour, int near = 24);
inline Blob blobOf(const QImage& image, const Colour& colour) {
    return blobOf(image, QColor(colour.red, colour.green, colour.blue));
}

/// Of pixels in which two pictures differ.
std::vector<QPoint> differences(const QImage& a, const QImage& b);

}  // namespace mrose
