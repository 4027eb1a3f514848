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
#include "widgets/real_robots.h"

namespace mrose {
namespace {

/// About bodies that are lit up, m, and how large the largest of them is seen then, pixels from its middle.
constexpr double litMargin = 2, leastLit = 24;
constexpr double fitMargin = 16, scaleBarHeight = 26, grabPixels = 6, dragPixels = 4;
/// What Ctrl rounds moves and turns to.
constexpr double roundMetres = 0.1, roundTurn = std::numbers::pi / 12;

double rounded(double value, double step) { return step * std::round(value / step); }

QRectF pixelsOf(const ViewTransform& view, const Area& area) {
    return {view.toPixels({area.least.x, area.most.y}), view.toPixels({area.most.x, area.least.y})};
}

/// An area in the middle of a rectangle, or above or beside what is covered where it need not be smaller for that.
void fitClear(ViewTransform& view, const Area& area, const QRectF& into, const QRectF& covered) {
    view.fit(area, into);
    const QRectF place = pixelsOf(view, area);
    if (!place.intersects(covered)) return;
    const double up = place.bottom() + fitMargin - covered.top(), left = place.right() + fitMargin - covered.left();
    if (up <= place.top() - into.top())
        view.pan({0, up}, {0, 0});
    else if (left <= place.left() - into.left())
        view.pan({left, 0}, {0, 0});
}

}  // namespace

FieldView::FieldView(QWidget* parent) : QWidget(parent) {
    setMouseTracking(true);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Field"));
}

void FieldView::setFrame(std::shared_ptr<const FieldFrame> frame) {
    const bool other = !frame_ || !frame || frame_->scenario != frame->scenario;
    const bool otherReality = frame_ && frame && frame_->reality != frame->reality;
    frame_ = std::move(frame);
    if (otherReality && fitted_) fitAgain();
    if (other) {
        const std::size_t bodies = frame_ ? frame_->scene().bodyCount() : 0;
        if (focus_.selected && *focus_.selected >= bodies) setSelected(std::nullopt);
        focus_.hovered.reset();
        cancelDrag();
        if (fitted_) fitAgain();
    }
    followSelected();
    update();
}

void FieldView::setEditable(bool editable) {
    editable_ = editable;
    if (!editable) focus_.lit.clear();
    if (!editable && focus_.moved) cancelDrag();
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
    if (fitted_) fitAgain();  // rulers take room
    update();
    emit layersChanged(layers);
}

void FieldView::setSelected(std::optional<std::size_t> body) {
    if (body == focus_.selected) return;
    finishNudge();
    focus_.selected = body;
    focus_.lit.clear();
    emit bodySelected(body);
    followSelected();
    update();
}

void FieldView::setFollowing(bool following) {
    following_ = following;
    followSelected();
    update();
}

void FieldView::followSelected() {
    if (!following_ || !frame_ || !focus_.selected) return;
    view_.setCentre(position(frame_->poseOf(*focus_.selected)));
    fitted_ = false;
}

Area FieldView::wholeArea() const {
    if (!frame_) return {{0, 0}, {-1, -1}};
    Area place = areaOf(frame_->scene().environment);
    if (place.empty()) return areaOf(*frame_);
    if (frame_->reality) place.include(areaOf(*frame_->reality));
    return place;
}

QMarginsF FieldView::fitMargins() const {
    const QMarginsF margins(fitMargin, fitMargin, fitMargin, scaleBarHeight);
    return layers_.has(FieldLayer::grid) ? margins + QMarginsF(rulerWidth, rulerHeight, 0, 0) : margins;
}

void FieldView::fit() {
    part_.reset();
    fitAgain();
}

void FieldView::fit(const Area& area) {
    part_ = area;
    fitAgain();
}

void FieldView::fitAgain() {
    if (!frame_) return;
    fitClear(view_, part_.value_or(wholeArea()), QRectF(rect()).marginsRemoved(fitMargins()), focus_.covered);
    fitted_ = true;
    focus_.lit.clear();
    update();
}

QRectF FieldView::fittedPlace() const {
    const Area area = wholeArea();
    if (area.empty()) return {};
    ViewTransform fitted = view_;
    fitClear(fitted, area, QRectF(rect()).marginsRemoved(fitMargins()), focus_.covered);
    return pixelsOf(fitted, area);
}

double FieldView::fittedScale(const QSizeF& size) const {
    const Area area = wholeArea();
    if (area.empty()) return 0;
    ViewTransform fitted = view_;
    fitted.fit(area, QRectF({0, 0}, size).marginsRemoved(fitMargins()));
    return fitted.scale();
}

void FieldView::setCovered(const QRectF& covered) {
    if (std::exchange(focus_.covered, covered) == covered) return;
    if (fitted_ && frame_)
        fitClear(view_, part_.value_or(wholeArea()), QRectF(rect()).marginsRemoved(fitMargins()), covered);
    update();
}

void FieldView::lightUp(const std::vector<std::size_t>& bodies) {
    if (!frame_ || bodies.empty()) return;
    Area near{{1, 1}, {-1, -1}}, close = near;
    double reach = 0;
    for (const std::size_t body : bodies) {
        near.include(position(frame_->poseOf(body)), litMargin);
        close.include(position(frame_->poseOf(body)), frame_->scene().shapeOf(body).reach);
        reach = std::max(reach, frame_->scene().shapeOf(body).reach);
    }
    const Area seen = view_.shown();
    const bool inside = close.least.x >= seen.least.x && close.least.y >= seen.least.y && close.most.x <= seen.most.x &&
                        close.most.y <= seen.most.y;
    // Who has chosen a scale at which they are seen well keeps it.
    if (!inside || reach * view_.scale() < leastLit) {
        view_.fit(near, QRectF(rect()).marginsRemoved(fitMargins()));
        fitted_ = false;
    }
    focus_.lit = bodies;
    update();
}

void FieldView::setElsewhere(std::vector<std::optional<Point>> elsewhere) {
    focus_.elsewhere = std::move(elsewhere);
    update();
}

void FieldView::followLabels(const LabelPlacer& labels) {
    likeLabels_ = labels;
    if (!labels_.standsLike(labels)) update();
}

void FieldView::setView(const ViewTransform& view) {
    ViewTransform like = view_;
    like.showLike(view);
    if (like == view_) return;
    view_ = reportedView_ = like;
    fitted_ = false;
    followSelected();
    update();
}

void FieldView::zoom(double factor) {
    view_.zoom(factor, QPointF(width() / 2.0, height() / 2.0));
    fitted_ = false;
    update();
}

void FieldView::panBy(const QPointF& pixels) {
    view_.pan({0, 0}, pixels);
    fitted_ = false;
    update();
}

std::optional<std::size_t> FieldView::bodyAt(const QPointF& pixels) const {
    if (!frame_) return std::nullopt;
    const Point at = view_.toMetres(pixels);
    const double slack = grabPixels / view_.scale();
    const ConvexPiece finger = ConvexPiece::circle(at, slack);
    for (std::size_t i = frame_->scene().bodyCount(); i-- > 0;) {
        const Shape& shape = frame_->scene().shapeOf(i);
        const Pose& pose = frame_->poseOf(i);
        if (distance(position(pose), at) > shape.reach + slack) continue;
        const Placement placement(pose);
        for (const ConvexPiece& piece : shape.pieces)
            if (mrose::distance(placed(piece, placement), finger) <= 0) return i;
    }
    return std::nullopt;
}

void FieldView::drawPlace(double ratio) {
    place_ = QPixmap(size() * ratio);
    place_.setDevicePixelRatio(ratio);
    placeView_ = view_;
    placeOf_ = frame_->scenario.get();
    QPainter painter(&place_);
    painter.setFont(font());
    FieldPainter(painter, view_, theme_, layers_).place(frame_->scene().environment);
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
    if (place_.isNull() || !(placeView_ == view_) || placeOf_ != frame_->scenario.get() ||
        place_.devicePixelRatio() != ratio)
        drawPlace(ratio);
    painter.drawPixmap(0, 0, place_);
    FieldPainter field(painter, view_, theme_, layers_);
    if (likeLabels_) labels_.followOther(*likeLabels_);
    field.frame(*frame_, focus_, labels_);
    field.corners(*frame_, focus_.covered);
    if (!labels_.standsLike(reportedLabels_)) emit labelsMoved(reportedLabels_ = labels_);
    if (!(reportedView_ == view_)) emit viewChanged(reportedView_ = view_);
    if (drag_ == Drag::measure) field.measure(view_.toMetres(pressedAt_), view_.toMetres(draggedTo_));
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
    FieldPicture picture{view_, theme_, layers_, {focus_.selected, {}, {}}, following_, font()};
    if (fitted_) picture.whole = part_.value_or(wholeArea());
    picture.margins = fitMargins();
    return picture;
}

void FieldView::resizeEvent(QResizeEvent* event) {
    view_.setSize(event->size());
    if (fitted_) fitAgain();
}

void FieldView::wheelEvent(QWheelEvent* event) {
    view_.zoom(std::pow(1.0015, event->angleDelta().y()), event->position());
    fitted_ = false;
    followSelected();
    update();
    event->accept();
}

void FieldView::mousePressEvent(QMouseEvent* event) {
    setFocus();
    finishNudge();
    if (drag_ != Drag::none || !frame_) return;
    button_ = event->button();
    pressedAt_ = draggedTo_ = event->localPos();
    const bool measuring = button_ == Qt::LeftButton && event->modifiers().testFlag(Qt::ShiftModifier);
    drag_ = measuring ? Drag::measure : Drag::pressed;
    pressedOnKnob_ = !measuring && button_ == Qt::LeftButton && onKnob(pressedAt_);
    const std::optional<std::size_t> body = pressedOnKnob_ ? focus_.selected : bodyAt(pressedAt_);
    pressedOnBody_ = body.has_value();
    if (!measuring && body) setSelected(body);
}

void FieldView::mouseDoubleClickEvent(QMouseEvent* event) {
    // Of a view that follows, the body that the first press selected may have gone from under the cursor.
    const bool again = pressedOnBody_ && event->localPos() == pressedAt_;
    if (!again) mousePressEvent(event);
    if (event->button() == Qt::LeftButton && pressedOnBody_) emit followRequested();
}

void FieldView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF at = event->localPos();
    emit cursorMoved(view_.toMetres(at));
    if (drag_ != Drag::none) {
        drag(at, event->modifiers().testFlag(Qt::ControlModifier));
        return;
    }
    const bool knob = onKnob(at);
    const std::optional<std::size_t> body = knob ? focus_.selected : bodyAt(at);
    setCursor(knob        ? Qt::CrossCursor
              : !body     ? Qt::ArrowCursor
              : editable_ ? Qt::SizeAllCursor
                          : Qt::PointingHandCursor);
    if (body == focus_.hovered) return;
    focus_.hovered = body;
    update();
}

/// At the end of the selected robot's arrow.
bool FieldView::onKnob(const QPointF& at) const {
    if (!frame_ || !hasKnob(*frame_, focus_)) return false;
    return QLineF(knobAt(view_, *frame_, *focus_.selected), at).length() <= knobRadius + grabPixels / 2;
}

/// A press has become a drag: of what?
void FieldView::beginDrag() {
    const bool onBody = focus_.selected && bodyAt(pressedAt_) == focus_.selected;
    drag_ = pressedOnKnob_ ? Drag::turn : Drag::pan;
    if (pressedOnKnob_) return;
    if (onBody && !editable_ && button_ == Qt::LeftButton) emit dragRefused();
    if (onBody && editable_ && button_ != Qt::MiddleButton)
        drag_ = button_ == Qt::RightButton ? Drag::turn : Drag::move;
    else if (button_ == Qt::RightButton)
        drag_ = Drag::none;
}

Pose FieldView::draggedPose(const QPointF& at, bool round) const {
    Pose pose = frame_->poseOf(*focus_.selected);
    if (drag_ == Drag::move) {
        const Point to = position(pose) + view_.toMetres(at) - view_.toMetres(pressedAt_);
        pose.x = round ? rounded(to.x, roundMetres) : to.x;
        pose.y = round ? rounded(to.y, roundMetres) : to.y;
        return pose;
    }
    const Point to = view_.toMetres(at) - position(pose), from = view_.toMetres(pressedAt_) - position(pose);
    // From near its middle a body is turned to face the cursor, otherwise along with where it was taken.
    const double turned = std::atan2(to.y, to.x) -
                          (length(from) * view_.scale() < 2 * grabPixels ? pose.heading : std::atan2(from.y, from.x));
    const double heading = pose.heading + turned;
    pose.heading = wrapAngle(round ? rounded(heading, roundTurn) : heading);
    return pose;
}

void FieldView::drag(const QPointF& at, bool round) {
    if (drag_ == Drag::pressed) {
        if ((at - pressedAt_).manhattanLength() < dragPixels) return;
        beginDrag();
    }
    if (drag_ == Drag::pan) {
        view_.pan(draggedTo_, at);
        fitted_ = false;
    } else if ((drag_ == Drag::move || drag_ == Drag::turn) && focus_.selected) {
        focus_.moved = draggedPose(at, round);
    }
    draggedTo_ = at;
    update();
}

void FieldView::cancelDrag() {
    drag_ = Drag::none;
    if (std::exchange(nudging_, false)) QCoreApplication::instance()->removeEventFilter(this);
    focus_.moved.reset();
    update();
}

void FieldView::mouseReleaseEvent(QMouseEvent* event) {
    if (drag_ == Drag::none || event->button() != button_) return;
    const Drag done = std::exchange(drag_, Drag::none);
    if (done == Drag::pressed && button_ == Qt::LeftButton && !pressedOnBody_) setSelected(std::nullopt);
    const std::optional<Pose> moved = std::exchange(focus_.moved, std::nullopt);
    if (moved && focus_.selected) emit bodyMoved(*focus_.selected, *moved);
    update();
}

void FieldView::nudge(const Pose& by) {
    if (!editable_ || !frame_ || !focus_.selected || drag_ != Drag::none) return;
    Pose pose = focus_.moved.value_or(frame_->poseOf(*focus_.selected));
    pose = {pose.x + by.x, pose.y + by.y, wrapAngle(pose.heading + by.heading)};
    focus_.moved = pose;
    update();
    if (!std::exchange(nudging_, true)) QCoreApplication::instance()->installEventFilter(this);
    if (!QGuiApplication::keyboardModifiers().testFlag(Qt::AltModifier)) finishNudge();
}

void FieldView::finishNudge() {
    if (!std::exchange(nudging_, false)) return;
    QCoreApplication::instance()->removeEventFilter(this);
    const std::optional<Pose> moved = std::exchange(focus_.moved, std::nullopt);
    if (moved && focus_.selected) emit bodyMoved(*focus_.selected, *moved);
    update();
}

/// While nudges add up: of the whole program's events those that end that.
bool FieldView::eventFilter(QObject* watched, QEvent* event) {
    const bool released = event->type() == QEvent::KeyRelease && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Alt;
    if (released || event->type() == QEvent::ApplicationDeactivate) finishNudge();
    return QWidget::eventFilter(watched, event);
}

void FieldView::leaveEvent(QEvent* /*event*/) {
    focus_.hovered.reset();
    emit cursorMoved(std::nullopt);
    update();
}

QString FieldView::readoutAt(const QPointF& pixels) const {
    if (!frame_) return {};
    if (onKnob(pixels)) return tr("Drag it to turn %1").arg(qtText(frame_->nameOf(*focus_.selected)));
    const QString signs = signReadout(*frame_, view_.toMetres(pixels), grabPixels / view_.scale());
    const std::optional<std::size_t> body = bodyAt(pixels);
    QStringList parts;
    if (body) parts += bodyReadout(*frame_, *body);
    if (layers_.has(FieldLayer::reality)) parts += realReadout(*frame_, body, view_.toMetres(pixels));
    if (body && layers_.has(FieldLayer::models)) parts += modelReadout(*frame_, *body);
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
    // Escape belongs to whoever is dragging, whatever it does elsewhere.
    const bool key = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
    if (key && (drag_ != Drag::none || nudging_) && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        if (event->type() == QEvent::KeyPress) cancelDrag();
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

}  // namespace mrose
