#include "widgets/field_view.h"

#include <QGuiApplication>
#include <QHelpEvent>
#include <QMouseEvent>
#include <QPaintEvent>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "widgets/field_readout.h"
#include "widgets/qt_text.h"
#include "widgets/real_readout.h"

namespace mrose {
namespace {

constexpr double dragPixels = 4;

}  // namespace

FieldView::FieldView(QWidget* parent)
    : QWidget(parent), viewport_([this](bool fits) {
          if (fits) focus_.lit.clear();
          focus_.covered = viewport_.covered();
          update();
      }) {
    setMouseTracking(true);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Field"));
    viewport_.setRulers(layers_.has(FieldLayer::grid));
}

void FieldView::setFrame(std::shared_ptr<const FieldFrame> frame) {
    const bool other = !frame_ || !frame || frame_->scenario != frame->scenario;
    frame_ = std::move(frame);
    viewport_.setFrame(frame_);
    if (other) {
        const std::size_t bodies = frame_ ? frame_->scene().bodyCount() : 0;
        if (focus_.selected && *focus_.selected >= bodies) setSelected(std::nullopt);
        focus_.hovered.reset();
        endDrag(false);
    }
    update();
}

void FieldView::setEditable(bool editable) {
    if (!editable) focus_.lit.clear();
    if (!editable && focus_.moved) endDrag(false);
    if (std::exchange(focus_.turnable, editable) != editable) update();
}

void FieldView::setEmptyText(const QString& text) {
    emptyText_ = text;
    update();
}

void FieldView::setTheme(const Theme& theme) {
    theme_ = theme;
    place_ = {};
    update();
}

void FieldView::setLayers(const FieldLayers& layers) {
    layers_ = layers;
    place_ = {};
    viewport_.setRulers(layers.has(FieldLayer::grid));
    update();
    emit layersChanged(layers);
}

void FieldView::setSelected(std::optional<std::size_t> body) {
    if (body == focus_.selected) return;
    if (nudging_) endDrag(true);
    focus_.selected = body;
    focus_.lit.clear();
    emit bodySelected(body);
    viewport_.setSelected(focus_.selected);
    update();
}

void FieldView::lightUp(const std::vector<std::size_t>& bodies) {
    if (!frame_ || bodies.empty()) return;
    viewport_.showNear(bodies);
    focus_.lit = bodies;
    update();
}

void FieldView::setElsewhere(std::vector<std::optional<Point>> elsewhere) {
    focus_.elsewhere = std::move(elsewhere);
    update();
}

void FieldView::setBands(const RobotBands& bands) {
    if (bands == focus_.bands) return;
    focus_.bands = bands;
    update();
}

void FieldView::followLabels(const LabelPlacer& labels) {
    likeLabels_ = labels;
    if (!labels_.standsLike(labels)) update();
}

void FieldView::setView(const ViewTransform& view) {
    ViewTransform like = transform();
    like.showLike(view);
    if (viewport_.showLike(view)) reportedView_ = like;
}

void FieldView::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    if (!frame_) {
        painter.fillRect(rect(), theme_.surround);
        painter.setPen(theme_.quietText);
        painter.drawText(rect().adjusted(40, 40, -40, -40), Qt::AlignCenter | Qt::TextWordWrap, emptyText_);
        return;
    }
    const double ratio = painter.deviceTransform().m11();  // of what is painted on, be it a screen or a picture
    if (place_.isNull() || !(placeView_ == transform()) || placeOf_ != frame_->scenario.get() ||
        place_.devicePixelRatio() != ratio) {
        place_ = QPixmap(size() * ratio);
        place_.setDevicePixelRatio(ratio);
        placeView_ = transform();
        placeOf_ = frame_->scenario.get();
        QPainter on(&place_);
        on.setFont(font());
        FieldPainter(on, placeView_, theme_, layers_).place(frame_->scene().environment);
    }
    painter.drawPixmap(0, 0, place_);
    FieldPainter field(painter, transform(), theme_, layers_);
    if (likeLabels_) labels_.followOther(*likeLabels_);
    field.frame(*frame_, focus_, labels_, legend_);
    field.corners(*frame_, legend_);
    if (!labels_.standsLike(reportedLabels_)) emit labelsMoved(reportedLabels_ = labels_);
    if (!(reportedView_ == transform())) emit viewChanged(reportedView_ = transform());
    if (drag_.kind == FieldDrag::Kind::measure)
        field.measure(transform().toMetres(drag_.from), transform().toMetres(drag_.to));
}

void FieldView::paint(QPainter& painter, const QSizeF& size) const {
    if (!frame_) return;
    FieldPicture as = picture();
    as.following = false;
    as.focus = focus_;
    as.focus.turnable = false;
    as.focus.covered = {};
    as.labels = labels_;
    as.paint(painter, size, *frame_);
}

FieldPicture FieldView::picture() const {
    FieldPicture picture{transform(), theme_, layers_, {focus_.selected, {}, {}}, viewport_.following(), font()};
    // Of other ticks only those of all of a run say something.
    if (focus_.bands.ofRun) picture.focus.bands = focus_.bands;
    picture.whole = viewport_.fitted();
    picture.margins = viewport_.margins();
    return picture;
}

void FieldView::resizeEvent(QResizeEvent* event) { viewport_.setSize(event->size()); }

void FieldView::wheelEvent(QWheelEvent* event) {
    viewport_.zoom(std::pow(1.0015, event->angleDelta().y()), event->position());
    event->accept();
}

void FieldView::mousePressEvent(QMouseEvent* event) {
    setFocus();
    if (nudging_) endDrag(true);
    if (held() || !frame_) return;
    const QPointF at = event->localPos();
    const bool left = event->button() == Qt::LeftButton;
    const bool measuring = left && event->modifiers().testFlag(Qt::ShiftModifier);
    const bool knob = !measuring && left && isOnKnob(*frame_, focus_, transform(), at);
    const std::optional<std::size_t> body = knob ? focus_.selected : bodyAt(*frame_, transform(), at);
    drag_ = {measuring ? FieldDrag::Kind::measure : FieldDrag::Kind::pressed,
             event->button(),
             at,
             at,
             body.has_value(),
             knob};
    if (!measuring && body) setSelected(body);
}

void FieldView::mouseDoubleClickEvent(QMouseEvent* event) {
    // Of a view that follows, the body that the first press selected may have gone from under the cursor.
    const bool again = drag_.onBody && event->localPos() == drag_.from;
    if (!again) mousePressEvent(event);
    if (event->button() == Qt::LeftButton && drag_.onBody) emit followRequested();
}

void FieldView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF at = event->localPos();
    emit cursorMoved(transform().toMetres(at));
    if (!held()) {
        const bool knob = frame_ && isOnKnob(*frame_, focus_, transform(), at);
        const std::optional<std::size_t> body = knob     ? focus_.selected
                                                : frame_ ? bodyAt(*frame_, transform(), at)
                                                         : std::nullopt;
        setCursor(knob              ? Qt::CrossCursor
                  : !body           ? Qt::ArrowCursor
                  : focus_.turnable ? Qt::SizeAllCursor
                                    : Qt::PointingHandCursor);
        if (std::exchange(focus_.hovered, body) != body) update();
        return;
    }
    if (drag_.kind == FieldDrag::Kind::pressed) {
        if ((at - drag_.from).manhattanLength() < dragPixels) return;
        const bool onSelected = focus_.selected && bodyAt(*frame_, transform(), drag_.from) == focus_.selected;
        // Who is asked may allow it.
        if (onSelected && !drag_.onKnob && !focus_.turnable && drag_.button == Qt::LeftButton) emit dragRefused();
        drag_.kind = drag_.dragged(onSelected, focus_.turnable);
    }
    if (drag_.kind == FieldDrag::Kind::pan) viewport_.pan(drag_.to, at);
    drag_.to = at;
    if (drag_.ofBody() && focus_.selected)
        focus_.moved = drag_.posed(frame_->poseOf(*focus_.selected), transform(),
                                   event->modifiers().testFlag(Qt::ControlModifier));
    update();
}

void FieldView::mouseReleaseEvent(QMouseEvent* event) {
    if (!held() || event->button() != drag_.button) return;
    const FieldDrag::Kind done = std::exchange(drag_.kind, FieldDrag::Kind::none);
    if (done == FieldDrag::Kind::pressed && drag_.button == Qt::LeftButton && !drag_.onBody) setSelected(std::nullopt);
    endDrag(true);
}

void FieldView::endDrag(bool keep) {
    drag_.kind = FieldDrag::Kind::none;
    if (std::exchange(nudging_, false)) QCoreApplication::instance()->removeEventFilter(this);
    const std::optional<Pose> moved = std::exchange(focus_.moved, std::nullopt);
    if (keep && moved && focus_.selected) emit bodyMoved(*focus_.selected, *moved);
    update();
}

void FieldView::nudge(const Pose& by) {
    if (!focus_.turnable || !frame_ || !focus_.selected || held()) return;
    Pose pose = focus_.moved.value_or(frame_->poseOf(*focus_.selected));
    const Point way = transform().onField(position(by));
    pose = {pose.x + way.x, pose.y + way.y, wrapAngle(pose.heading + by.heading)};
    focus_.moved = pose;
    update();
    if (!std::exchange(nudging_, true)) QCoreApplication::instance()->installEventFilter(this);
    if (!QGuiApplication::keyboardModifiers().testFlag(Qt::AltModifier)) endDrag(true);
}

/// While nudges add up: of the whole program's events those that end that.
bool FieldView::eventFilter(QObject* watched, QEvent* event) {
    const bool released = event->type() == QEvent::KeyRelease && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Alt;
    if (nudging_ && (released || event->type() == QEvent::ApplicationDeactivate)) endDrag(true);
    return QWidget::eventFilter(watched, event);
}

QString FieldView::readoutAt(const QPointF& pixels) const {
    if (!frame_) return {};
    if (isOnKnob(*frame_, focus_, transform(), pixels))
        return tr("Drag it to turn %1").arg(qtText(frame_->nameOf(*focus_.selected)));
    const QString signs = signReadout(*frame_, transform().toMetres(pixels), grabPixels / transform().scale());
    const std::optional<std::size_t> body = bodyAt(*frame_, transform(), pixels);
    QStringList parts;
    if (body) parts += bodyReadout(*frame_, *body);
    if (layers_.has(FieldLayer::reality)) parts += realReadout(*frame_, body, transform().toMetres(pixels));
    if (body && layers_.has(FieldLayer::models)) parts += modelReadout(*frame_, *body);
    if (body && layers_.has(FieldLayer::uncertainty)) parts += bandReadout(*frame_, focus_.bands, *body);
    parts += readingReadout(transform(), *frame_, shownLooks(*frame_, layers_, focus_), pixels);
    parts += scanReadout(transform(), *frame_, shownScans(*frame_, layers_, focus_), pixels);
    if (layers_.has(FieldLayer::radio)) parts += radioReadout(transform(), *frame_, focus_, pixels);
    parts += signs;
    parts.removeAll({});
    return parts.join('\n');
}

bool FieldView::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        QToolTip::showText(help->globalPos(), readoutAt(help->pos()), this);
        return true;
    }
    if (event->type() == QEvent::Leave) {
        focus_.hovered.reset();
        emit cursorMoved(std::nullopt);
        update();
    }
    // Escape belongs to whoever is dragging, whatever it does elsewhere.
    const bool key = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
    if (key && (held() || nudging_) && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        if (event->type() == QEvent::KeyPress) endDrag(false);
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

}  // namespace mrose
