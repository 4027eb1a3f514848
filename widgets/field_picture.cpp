#include "widgets/field_picture.h"

namespace mrose {

void FieldPicture::paint(QPainter& painter, const QSizeF& size, const FieldFrame& frame) {
    ViewTransform as = view;
    FieldFocus on = focus;
    if (on.selected && *on.selected >= frame.scene().bodyCount()) on = {};
    if (following && on.selected) as.setCentre(position(frame.poseOf(*on.selected)));
    if (size != as.size()) {
        const FieldArea seen = as.shown();
        as.setSize(size);
        whole ? as.fit(*whole, fitMargin) : as.fit(seen, 0);
    }
    painter.setFont(font);
    FieldPainter field(painter, as, theme, layers);
    field.place(frame.scene().environment);
    field.frame(frame, on, labels);
    field.corners();
}

}  // namespace mrose
