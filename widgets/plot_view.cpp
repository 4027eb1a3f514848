#include "widgets/plot_view.h"

#include <QLabel>
#include <QMouseEvent>
#include <QPicture>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <limits>

#include <qcustomplot.h>

#include "debug/plotted_value.h"
#include "widgets/plot_band.h"
#include "widgets/timeline_bar.h"

namespace mrose {
namespace {

constexpr double timesCurves = 10;
constexpr double shortestView = 10;                        // ticks
constexpr int shortestPause = 40;                          // ms, between pictures while numbers come
constexpr double growth = 1.15;                            // of the view, when the known time outgrows it
constexpr int leastWidth = 140;                            // pixels
constexpr int leastBand = 62, bandGap = 2, timeRoom = 30;  // pixels: of an axis with its title, between, below all

/// Of so many ticks in a pixel a curve is a band of noise: it is drawn in Qt's fast way, one pixel wide.
constexpr std::int64_t dense = 16;

QString titleOf(const QString& quantity, const QString& unit) {
    if (quantity.isEmpty()) return unit.isEmpty() ? QObject::tr("number") : unit;
    return unit.isEmpty() ? quantity : quantity + " (" + unit + ')';
}

/// The least range that an axis shows, so that noise of the last digit does not fill it.
double leastSpan(const QString& unit) { return unit == QString::fromUtf8("\u00b0") ? 4 : 0.02; }

}  // namespace

PlotView::PlotView(QWidget* parent)
    : QWidget(parent), plot_(new QCustomPlot), readOut_(new QLabel(this)), soon_(new QTimer(this)) {
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
    readOut_->setAttribute(Qt::WA_TransparentForMouseEvents);
    readOut_->setTextFormat(Qt::RichText);
    readOut_->setMargin(5);
    readOut_->hide();
    soon_->setSingleShot(true);
    connect(soon_, &QTimer::timeout, this, &PlotView::refresh);
    connect(plot_, &QCustomPlot::beforeReplot, this, [this] {
        if (std::exchange(dirty_, false)) fill();
    });
}

PlotView::~PlotView() = default;

double PlotView::seconds(double tick) const { return tick * toSeconds(time_.tickLength); }

void PlotView::setCurves(std::vector<PlotCurve> curves, const QString& ghostName) {
    ghostName_ = ghostName;
    curves_ = std::move(curves);
    layOut();
    refresh();
}

void PlotView::layOut() {
    plot_->clearGraphs();
    plot_->clearItems();
    plot_->plotLayout()->clear();
    bands_.clear();
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        const auto same = [&](const std::unique_ptr<Band>& band) { return band->unit == curves_[i].unit; };
        auto band = std::find_if(bands_.begin(), bands_.end(), same);
        if (band == bands_.end()) {
            addBand(curves_[i].unit, static_cast<int>(bands_.size()));
            band = bands_.end() - 1;
        }
        if (!curves_[i].ahead.isEmpty())
            (*band)->ahead.emplace_back(i, plot_->addGraph((*band)->time(), (*band)->value()));
        (*band)->graphs.emplace_back(i, plot_->addGraph((*band)->time(), (*band)->value()));
    }
    for (const auto& band : bands_) {
        QString quantity = curves_[band->graphs.front().first].quantity;
        for (const auto& [index, graph] : band->graphs)
            if (curves_[index].quantity != quantity) quantity.clear();
        band->called = titleOf(quantity, band->unit);
        addReferences(*band);
        const bool bottom = band == bands_.back();
        band->time()->setTickLabels(bottom);
        const int titled = QFontMetrics(titleFont()).height() + 1;
        band->rect->setMargins({leftMargin, titled, rightMargin, bottom ? 4 + timeRoom : 4});
        band->rect->setMinimumSize(50, leastBand - titled - 4);
        if (bottom) band->time()->setLabel(tr("time (s)"));
    }
    updateGeometry();
    setMinimumHeight(minimumSizeHint().height());
    paintTheme();
}

QFont PlotView::titleFont() const {
    QFont small = font();
    small.setPointSizeF(8);
    return small;
}

/// No axis is too low to be read.
QSize PlotView::minimumSizeHint() const {
    const int axes = std::max(1, static_cast<int>(bands_.size()));
    return {leastWidth, std::max(90, axes * leastBand + (axes - 1) * bandGap + timeRoom)};
}

void PlotView::addBand(const QString& unit, int row) {
    auto band = std::make_unique<Band>();
    band->unit = unit;
    band->rect = new QCPAxisRect(plot_);
    // The margins are fixed: nothing moves when labels get longer.
    band->rect->setAutoMargins(QCP::msNone);
    band->rect->setLayer("background");  // below its grid
    plot_->plotLayout()->addElement(row, 0, band->rect);
    for (QCPAxis* axis : band->rect->axes()) {
        axis->setLayer("axes");
        axis->grid()->setLayer("grid");
    }
    band->time()->grid()->setVisible(true);
    band->value()->grid()->setVisible(true);
    band->value()->setNumberFormat("gb");
    band->value()->setRange(-1e-9, 1e-9);  // an empty one is refused; any data widen it
    const auto line = [&](QCPItemLine*& item) {
        item = new QCPItemLine(plot_);
        item->setLayer("overlay");
        item->setClipAxisRect(band->rect);
        for (QCPItemPosition* end : {item->start, item->end}) {
            end->setAxisRect(band->rect);
            end->setAxes(band->time(), band->value());
            end->setTypeX(QCPItemPosition::ptPlotCoords);
            end->setTypeY(QCPItemPosition::ptAxisRectRatio);
        }
    };
    line(band->now);
    line(band->mouse);
    line(band->instant);
    band->mouse->setVisible(false);
    band->instant->setLayer("main");
    band->instant->setAntialiased(false);  // one pixel wide, wherever it lies
    band->unknown = new QCPItemRect(plot_);
    band->unknown->setLayer("grid");
    band->unknown->setClipAxisRect(band->rect);
    for (QCPItemPosition* corner : {band->unknown->topLeft, band->unknown->bottomRight}) {
        corner->setAxisRect(band->rect);
        corner->setAxes(band->time(), band->value());
        corner->setTypeX(QCPItemPosition::ptPlotCoords);
        corner->setTypeY(QCPItemPosition::ptAxisRectRatio);
    }
    band->title = new QCPItemText(plot_);
    band->title->setLayer("axes");
    band->title->setClipToAxisRect(false);
    band->title->setPositionAlignment(Qt::AlignLeft | Qt::AlignBottom);  // above the curves' room
    band->title->position->setAxisRect(band->rect);
    band->title->position->setType(QCPItemPosition::ptAxisRectRatio);
    band->title->position->setCoords(0, 0);
    band->title->setPadding({0, 0, 0, 1});
    bands_.push_back(std::move(band));
}

void PlotView::setReferences(std::vector<PlotLevel> levels, std::optional<std::int64_t> instant) {
    if (levels == levels_ && instant == instant_) return;
    levels_ = std::move(levels);
    instant_ = instant;
    layOut();
    refresh();
}

void PlotView::addReferences(Band& band) {
    for (std::size_t i = 0; i < levels_.size(); ++i)
        if (levels_[i].unit == band.unit) band.levels.emplace_back(i, plot_->addGraph(band.time(), band.value()));
    band.instant->setVisible(instant_.has_value());
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
    const QFont small = titleFont();
    readOut_->setFont(small);
    QColor grid = theme_.line;
    grid.setAlpha(theme_.dark ? 150 : 130);
    for (const auto& band : bands_) {
        band->rect->setBackground(theme_.dark ? theme_.surround : QColor(Qt::white));
        for (QCPAxis* axis : {band->time(), band->value()}) {
            axis->setBasePen(theme_.line);
            axis->setTickPen(theme_.line);
            axis->setSubTickPen(Qt::NoPen);
            axis->setTickLabelColor(theme_.quietText);
            axis->setLabelColor(theme_.text);
            axis->setTickLabelFont(small);
            axis->setLabelFont(small);
            axis->grid()->setPen(QPen(grid, 0));
            axis->grid()->setZeroLinePen(QPen(theme_.line, 0));
        }
        band->title->setFont(small);
        band->title->setColor(theme_.text);
        band->title->setPen(Qt::NoPen);
        band->now->setPen(QPen(theme_.accent, 2));
        band->mouse->setPen(QPen(theme_.quietText, 0, Qt::DotLine));
        band->instant->setPen(QPen(TimelineBar::colourOf(TimelineMark::Kind::divergence, theme_), 1));
        for (const auto& [level, graph] : band->levels)
            graph->setPen(QPen(TimelineBar::colourOf(TimelineMark::Kind::divergence, theme_), 1, Qt::DashLine));
        band->unknown->setPen(Qt::NoPen);
        band->unknown->setBrush(theme_.dark ? theme_.panel.lighter(115) : theme_.surround);
    }
    dirty_ = true;  // curves have their pens by how many ticks a pixel has
}

void PlotView::setTime(const Time& time) {
    if (time == time_) return;
    const bool moved = time.now != time_.now && time.first == time_.first && time.last == time_.last;
    time_ = time;
    const double from = from_, to = to_;
    if (all_) {
        const auto first = static_cast<double>(time_.first), last = static_cast<double>(time_.last);
        // Some room at the right, so that the scale does not change at each tick.
        const bool fits = from_ == first && to_ >= last && last - first > 0.6 * (to_ - from_);
        if (time_.end >= time_.last && time_.end > time_.first)
            setRange(first, reach());
        else if (!fits)
            setRange(first, std::max(first + (last - first) * growth, first + 250));
    } else {
        keepNowInView();
    }
    moveCursor();
    if (from != from_ || to != to_) return refresh();
    if (isVisible()) plot_->layer("overlay")->replot();
    if (!moved) refreshSoon();
}

/// A view of a part goes along when the cursor leaves it.
void PlotView::keepNowInView() {
    const auto now = static_cast<double>(time_.now);
    const double length = to_ - from_;
    if (now >= from_ && now <= to_) return;
    setRange(now > to_ ? now - 0.1 * length : now - 0.9 * length, now > to_ ? now + 0.9 * length : now + 0.1 * length);
}

void PlotView::setRange(double from, double to) {
    from_ = from;
    to_ = std::max(to, from + shortestView);
}

/// As far as anything is known or awaited.
double PlotView::reach() const { return static_cast<double>(std::max(time_.last, time_.end)); }

QStringList PlotView::titles() const {
    QStringList titles;
    for (const auto& band : bands_) titles << band->called;
    return titles;
}

std::pair<double, double> PlotView::rangeOf(int axis) const {
    const QCPRange range = bands_[static_cast<std::size_t>(axis)]->value()->range();
    return {range.lower, range.upper};
}

void PlotView::showAll() {
    all_ = true;
    setRange(static_cast<double>(time_.first), reach());
    refresh();
}

void PlotView::showRange(double from, double to) {
    all_ = false;
    setRange(from, to);
    refresh();
}

void PlotView::zoom(double factor, double aboutPixel) {
    const double width = std::max(1, plot_->width() - leftMargin - rightMargin);
    const double share = std::clamp((aboutPixel - leftMargin) / width, 0.0, 1.0);
    const double about = from_ + share * (to_ - from_);
    const double known = (reach() - static_cast<double>(time_.first)) * growth + 250;
    const double length = std::clamp((to_ - from_) / factor, shortestView, std::max(known, shortestView));
    double from = about - share * length;
    from = std::clamp(from, static_cast<double>(time_.first) - 0.5 * length, reach());
    all_ = false;
    setRange(from, from + length);
    refresh();
}

double PlotView::pixelOf(double tick) const {
    const double width = plot_->width() - leftMargin - rightMargin;
    return leftMargin + width * (tick - from_) / (to_ - from_);
}

std::int64_t PlotView::tickAt(double pixel) const {
    const double width = std::max(1, plot_->width() - leftMargin - rightMargin);
    const auto tick = std::llround(from_ + (pixel - leftMargin) / width * (to_ - from_));
    return std::max<std::int64_t>(tick, time_.first);
}

std::optional<QPointF> PlotView::placeOf(const QString& curve, double tick, double number) const {
    for (const auto& band : bands_)
        for (const auto& [index, graph] : band->graphs)
            if (curves_[index].id == curve)
                return QPointF(band->time()->coordToPixel(seconds(tick)), band->value()->coordToPixel(number));
    return {};
}

void PlotView::refresh() {
    dirty_ = true;
    if (isVisible()) plot_->replot(QCustomPlot::rpQueuedReplot);
}

void PlotView::draw() {
    dirty_ = true;
    plot_->replot();
}

void PlotView::paint(QPainter& painter, const QSize& size) {
    for (const auto& band : bands_) {
        band->now->setVisible(false);
        band->mouse->setVisible(false);
        band->unknown->setVisible(false);
    }
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

/// Numbers may come at each tick: who plays needs no more pictures than eyes can follow.
void PlotView::refreshSoon() {
    dirty_ = true;
    if (!soon_->isActive()) soon_->start(shortestPause);
}

void PlotView::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    refresh();
}

void PlotView::fill() {
    for (const auto& band : bands_) fillBand(*band);
    moveCursor();
}

void PlotView::fillBand(Band& band) {
    const double width = std::max(100, plot_->width() - leftMargin - rightMargin);
    const auto step = static_cast<std::int64_t>((to_ - from_) / width);
    // Its quantity and unit are at the end, behind the body's name.
    const QFontMetrics metrics(titleFont());
    const int room = plot_->width() - leftMargin - 2;
    const bool whole = metrics.horizontalAdvance(band.called) <= room;
    band.title->setText(metrics.elidedText(whole ? band.called : band.called.section(": ", -1), Qt::ElideLeft, room));
    double least = std::numeric_limits<double>::infinity(), most = -least;
    QVector<QPointF> points;
    for (const auto& [index, graph] : band.graphs) {
        points.clear();
        const auto from = static_cast<std::int64_t>(std::floor(from_)) - 1;
        curves_[index].sample(from, static_cast<std::int64_t>(std::ceil(to_)) + 1, step, points);
        QPen pen = curvePen(curves_[index]);
        if (step >= dense) pen.setWidthF(0);
        graph->setPen(pen);
        graph->setAntialiased(step < dense);
        QVector<QCPGraphData> drawn;
        drawn.reserve(points.size());
        for (const QPointF& point : points) {
            drawn.append({seconds(point.x()), point.y()});
            if (!std::isfinite(point.y())) continue;
            least = std::min(least, point.y());
            most = std::max(most, point.y());
        }
        graph->data()->set(drawn, true);
    }
    fillAhead(band, least, most);
    // Beside a bound many times as large nothing would be seen of the curves.
    const double size = least <= most ? std::max(std::abs(least), std::abs(most)) : 0;
    const double farthest = size > 0 ? timesCurves * size : std::numeric_limits<double>::infinity();
    for (const auto& [index, graph] : band.levels) {
        QVector<QCPGraphData> drawn;
        for (const QPointF& point : levels_[index].points) {
            drawn.append({seconds(point.x()), point.y()});
            if (std::abs(point.y()) > std::max(farthest, leastSpan(band.unit))) continue;
            least = std::min(least, point.y());
            most = std::max(most, point.y());
        }
        if (!drawn.isEmpty()) drawn.append({std::max(drawn.back().key, seconds(to_)), drawn.back().value});
        graph->data()->set(drawn, true);
    }
    if (instant_)
        for (QCPItemPosition* end : {band.instant->start, band.instant->end})
            end->setCoords(seconds(static_cast<double>(*instant_)), end == band.instant->start ? 0 : 1);
    band.time()->setRange(seconds(from_), seconds(to_));
    band.value()->ticker()->setTickCount(std::clamp(plot_->height() / static_cast<int>(bands_.size()) / 30, 1, 6));
    if (least > most) return;
    const bool fromZero = std::all_of(band.graphs.begin(), band.graphs.end(),
                                      [&](const auto& graph) { return curves_[graph.first].fromZero; });
    if (fromZero) least = 0;
    const double middle = (least + most) / 2, span = std::max(most - least, leastSpan(band.unit));
    const QCPRange now = band.value()->range();
    // A range that fits stays.
    const double low = fromZero ? 0 : middle - 0.5 * span, high = low + span;
    const bool begins = !fromZero || now.lower == 0;
    if (begins && low >= now.lower && high <= now.upper && span > 0.6 * now.size()) return;
    band.value()->setRange(fromZero ? 0 : low - 0.08 * span, high + 0.08 * span);
}

/// From where the run has come to.
void PlotView::fillAhead(Band& band, double& least, double& most) {
    const auto last = static_cast<double>(time_.last);
    const QColor known = theme_.dark ? theme_.surround : QColor(Qt::white);
    for (const auto& [index, graph] : band.ahead) {
        const PlotCurve& curve = curves_[index];
        QVector<QCPGraphData> drawn;
        const double joint = curve.at(time_.last);
        if (std::isfinite(joint)) drawn.append({seconds(last), joint});
        for (const QPointF& point : curve.ahead) {
            if (point.x() <= last) continue;
            drawn.append({seconds(point.x()), point.y()});
            if (!std::isfinite(point.y())) continue;
            least = std::min(least, point.y());
            most = std::max(most, point.y());
        }
        graph->setPen(aheadPen(curve, band.unknown->visible() ? band.unknown->brush().color() : known));
        graph->data()->set(drawn, true);
    }
}

void PlotView::moveCursor() {
    const double now = seconds(static_cast<double>(time_.now)), last = seconds(static_cast<double>(time_.last));
    for (const auto& band : bands_) {
        band->now->start->setCoords(now, 0);
        band->now->end->setCoords(now, 1);
        band->unknown->topLeft->setCoords(last, 0);
        band->unknown->bottomRight->setCoords(std::max(last, seconds(to_)), 1);
    }
}

}  // namespace mrose
