#include "widgets/field_picture.h"

namespace mrose {

void FieldPicture::paint(QPainter& painter, const QSizeF& size, const FieldFrame& frame) {
    ViewTransform as = view;
    FieldFocus on = focus;
    if (on.selected && *on.selected >= frame.scene().bodyCount()) on = {};
    if (following && on.selected) as.setCentre(position(frame.poseOf(*on.selected)));
    if (size != as.size()) {
        const Area seen = as.shown();
        as.setSize(size);
        const QRectF all(QPointF(0, 0), size);
        whole ? as.fit(*whole, all.marginsRemoved(margins)) : as.fit(seen, all);
    }
    painter.setFont(font);
    FieldPainter field(painter, as, theme, layers);
    field.place(frame.scene().environment);
    field.frame(frame, on, labels, legend);
    field.corners(frame, legend);
}

}  // namespace mrose
