#include "widgets/plot_view.h"

#include <QMouseEvent>
#include <QPicture>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include <qcustomplot.h>

#include "widgets/plot_band.h"
#include "widgets/plot_read_out.h"

namespace mrose {
namespace {

constexpr int shortestPause = 40;  // ms, between pictures while numbers come
constexpr int leastWidth = 140;    // pixels
constexpr int bandGap = 2;         // pixels

}  // namespace

PlotView::PlotView(QWidget* parent)
    : QWidget(parent), plot_(new QCustomPlot), readOut_(new PlotReadOut(this)), soon_(new QTimer(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(plot_);
    plot_->setPlottingHint(QCP::phFastPolylines);
    plot_->setNoAntialiasingOnDrag(true);
    plot_->layer("overlay")->setMode(QCPLayer::lmBuffered);
    plot_->installEventFilter(this);
    plot_->setMouseTracking(true);
    plot_->setCursor(Qt::PointingHandCursor);
    plot_->setAccessibleName(tr("Plots over time"));
    plot_->plotLayout()->setRowSpacing(bandGap);
    soon_->setSingleShot(true);
    connect(soon_, &QTimer::timeout, this, &PlotView::refresh);
    connect(plot_, &QCustomPlot::beforeReplot, this, [this] {
        if (!std::exchange(dirty_, false)) return;
        for (const auto& band : bands_) band->fill(axis_, static_cast<int>(bands_.size()));
        moveCursors();
    });
}

PlotView::~PlotView() = default;

void PlotView::setCurves(std::vector<PlotCurve> curves, const QString& ghostName) {
    ghostName_ = ghostName;
    curves_ = std::move(curves);
    layOut();
}

void PlotView::setReferences(std::vector<PlotLevel> levels, std::optional<std::int64_t> instant) {
    if (levels == levels_ && instant == instant_) return;
    levels_ = std::move(levels);
    instant_ = instant;
    layOut();
}

void PlotView::layOut() {
    plot_->clearGraphs();
    plot_->clearItems();
    plot_->plotLayout()->clear();
    bands_.clear();
    for (const PlotCurve& curve : curves_) {
        const auto same = [&](const std::unique_ptr<PlotBand>& band) { return band->unit() == curve.unit; };
        auto band = std::find_if(bands_.begin(), bands_.end(), same);
        if (band == bands_.end())
            band = bands_.insert(band, std::make_unique<PlotBand>(*plot_, curve.unit, static_cast<int>(bands_.size())));
        (*band)->addCurve(curve);
    }
    for (const auto& band : bands_) {
        for (const PlotLevel& level : levels_)
            if (level.unit == band->unit()) band->addLevel(level);
        band->finish(titleFont(), band == bands_.back());
    }
    updateGeometry();
    setMinimumHeight(minimumSizeHint().height());
    paintTheme();
    refresh();
}

QFont PlotView::titleFont() const {
    QFont small = font();
    small.setPointSizeF(8);
    return small;
}

/// No axis is too low to be read.
QSize PlotView::minimumSizeHint() const {
    const int axes = std::max(1, static_cast<int>(bands_.size()));
    return {leastWidth, std::max(90, axes * PlotBand::least + (axes - 1) * bandGap + PlotBand::timeRoom)};
}

void PlotView::setTheme(const Theme& theme) {
    theme_ = theme;
    paintTheme();
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

void PlotView::paintTheme() {
    plot_->setBackground(theme_.panel);
    readOut_->setStyleSheet(QString("background:%1;color:%2;border:1px solid %3")
                                .arg(theme_.panel.name(), theme_.text.name(), theme_.line.name()));
    readOut_->setFont(titleFont());
    for (const auto& band : bands_) band->setTheme(theme_, titleFont());
    dirty_ = true;  // curves have their pens by how many ticks a pixel has
}

void PlotView::setTime(const Time& time) {
    if (time == axis_.time()) return;
    const PlotAxis before = axis_;
    axis_.setTime(time);
    moveCursors();
    if (axis_.from() != before.from() || axis_.to() != before.to()) return refresh();
    if (isVisible()) plot_->layer("overlay")->replot();
    const Time& was = before.time();
    if (time.now == was.now || time.first != was.first || time.last != was.last) refreshSoon();
}

void PlotView::showAll() {
    axis_.showAll();
    refresh();
}

void PlotView::showRange(double from, double to) {
    axis_.show(from, to);
    refresh();
}

void PlotView::zoom(double factor, double aboutPixel) {
    axis_.zoom(factor, std::clamp((aboutPixel - PlotBand::leftMargin) / axisWidth(), 0.0, 1.0));
    refresh();
}

double PlotView::axisWidth() const {
    return std::max(1, plot_->width() - PlotBand::leftMargin - PlotBand::rightMargin);
}

double PlotView::pixelOf(double tick) const {
    return PlotBand::leftMargin + axisWidth() * (tick - axis_.from()) / (axis_.to() - axis_.from());
}

std::int64_t PlotView::tickAt(double pixel) const {
    const auto tick =
        std::llround(axis_.from() + (pixel - PlotBand::leftMargin) / axisWidth() * (axis_.to() - axis_.from()));
    return std::max<std::int64_t>(tick, axis_.time().first);
}

QStringList PlotView::titles() const {
    QStringList titles;
    for (const auto& band : bands_) titles << band->title();
    return titles;
}

std::pair<double, double> PlotView::rangeOf(int axis) const { return bands_[static_cast<std::size_t>(axis)]->range(); }

std::optional<QPointF> PlotView::placeOf(const QString& curve, double tick, double number) const {
    for (const auto& band : bands_)
        if (band->has(curve)) return band->placeOf(axis_.seconds(tick), number);
    return {};
}

QString PlotView::textAt(std::int64_t tick) const { return readOutText(curves_, ghostName_, axis_.time(), tick); }

void PlotView::refresh() {
    dirty_ = true;
    if (isVisible()) plot_->replot(QCustomPlot::rpQueuedReplot);
}

void PlotView::draw() {
    dirty_ = true;
    plot_->replot();
}

/// Numbers may come at each tick: who plays needs no more pictures than eyes can follow.
void PlotView::refreshSoon() {
    dirty_ = true;
    if (!soon_->isActive()) soon_->start(shortestPause);
}

void PlotView::paint(QPainter& painter, const QSize& size) {
    for (const auto& band : bands_) band->hideCursors();
    plot_->resize(size);
    draw();
    // It paints by a painter of its own.
    QPicture picture;
    QCPPainter recorder(&picture);
    recorder.setMode(QCPPainter::pmVectorized);
    plot_->toPainter(&recorder, size.width(), size.height());
    recorder.end();
    painter.drawPicture(0, 0, picture);
}

void PlotView::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    refresh();
}

void PlotView::moveCursors() {
    for (const auto& band : bands_) band->moveCursors(axis_, instant_);
}

void PlotView::hover(std::optional<QPointF> mouse) {
    const bool inside = mouse && !bands_.empty() && mouse->x() >= PlotBand::leftMargin &&
                        mouse->x() <= plot_->width() - PlotBand::rightMargin;
    std::optional<std::int64_t> tick;
    if (inside) tick = tickAt(mouse->x());
    for (const auto& band : bands_)
        band->setMouse(tick ? std::optional(axis_.seconds(static_cast<double>(*tick))) : std::nullopt);
    plot_->layer("overlay")->replot();
    readOut_->setVisible(inside);
    if (inside) {
        const QRect room = parentWidget() == nullptr ? rect() : rect() & QRect(-pos(), parentWidget()->size());
        readOut_->setText(textAt(*tick));
        readOut_->place(mouse->toPoint(), room, [&](const QRect& place) {
            const bool overMouse = place.left() <= mouse->toPoint().x() && place.right() >= mouse->toPoint().x();
            int cost = overMouse ? width() * static_cast<int>(curves_.size()) : 0;
            for (const auto& band : bands_)
                cost += band->coveredBy(
                    place, [this](double pixel) { return tickAt(pixel); }, axis_.time());
            return cost;
        });
        readOut_->raise();
    }
    emit hovered(tick);
}

void PlotView::press(const QMouseEvent& event) {
    if (event.button() == Qt::LeftButton && !bands_.empty()) {
        seeking_ = true;
        emit tickRequested(tickAt(event.localPos().x()));
    } else if (event.button() == Qt::RightButton || event.button() == Qt::MiddleButton) {
        panFrom_ = event.localPos().x();
    }
}

void PlotView::move(const QMouseEvent& event) {
    const double pixel = event.localPos().x();
    if (seeking_) emit tickRequested(tickAt(pixel));
    if (panFrom_) {
        axis_.pan((*panFrom_ - pixel) / axisWidth());
        panFrom_ = pixel;
        refresh();
    }
    hover(event.localPos());
}

bool PlotView::eventFilter(QObject* watched, QEvent* event) {
    if (watched != plot_) return QWidget::eventFilter(watched, event);
    switch (event->type()) {
        case QEvent::MouseButtonPress:
            press(*static_cast<QMouseEvent*>(event));
            return true;
        case QEvent::MouseMove:
            move(*static_cast<QMouseEvent*>(event));
            return true;
        case QEvent::MouseButtonRelease:
            seeking_ = false;
            panFrom_.reset();
            return true;
        case QEvent::MouseButtonDblClick:
            showAll();
            return true;
        case QEvent::Wheel: {
            const auto* wheel = static_cast<QWheelEvent*>(event);
            zoom(std::pow(1.2, wheel->angleDelta().y() / 120.0), wheel->position().x());
            event->accept();
            return true;
        }
        case QEvent::Leave:
            hover({});
            break;
        case QEvent::Resize:
            dirty_ = true;
            break;
        default:
            break;
    }
    return QWidget::eventFilter(watched, event);
}

}  // namespace mrose
