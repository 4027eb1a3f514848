#include "widgets/plot_band.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "widgets/timeline_glyphs.h"

namespace mrose {
namespace {

constexpr double timesCurves = 10;

/// Of so many ticks in a pixel a curve is a band of noise: it is drawn in Qt's fast way, one pixel wide.
constexpr std::int64_t dense = 16;

QString titleOf(const QString& quantity, const QString& unit) {
    if (quantity.isEmpty()) return unit.isEmpty() ? QObject::tr("number") : unit;
    return unit.isEmpty() ? quantity : quantity + " (" + unit + ')';
}

/// The least range that an axis shows, so that noise of the last digit does not fill it.
double leastSpan(const QString& unit) { return unit == QString::fromUtf8("\u00b0") ? 4 : 0.02; }

/// An item's place: an instant, and a share of the band's height.
void placeByTime(QCPItemPosition& position, QCPAxisRect& rect) {
    position.setAxisRect(&rect);
    position.setAxes(rect.axis(QCPAxis::atBottom), rect.axis(QCPAxis::atLeft));
    position.setTypeX(QCPItemPosition::ptPlotCoords);
    position.setTypeY(QCPItemPosition::ptAxisRectRatio);
}

QCPItemLine* uprightLine(QCustomPlot& plot, QCPAxisRect& rect) {
    auto* line = new QCPItemLine(&plot);
    line->setLayer("overlay");
    line->setClipAxisRect(&rect);
    for (QCPItemPosition* end : {line->start, line->end}) placeByTime(*end, rect);
    return line;
}

void moveTo(QCPItemLine& line, double second) {
    line.start->setCoords(second, 0);
    line.end->setCoords(second, 1);
}

}  // namespace

/// The numbers that are drawn.
struct PlotBand::Extent {
    double least = std::numeric_limits<double>::infinity(), most = -least;

    void include(double number) {
        if (!std::isfinite(number)) return;
        least = std::min(least, number);
        most = std::max(most, number);
    }
};

PlotBand::PlotBand(QCustomPlot& plot, const QString& unit, int row)
    : unit_(unit), plot_(plot), rect_(new QCPAxisRect(&plot)) {
    // The margins are fixed: nothing moves when labels get longer.
    rect_->setAutoMargins(QCP::msNone);
    rect_->setLayer("background");  // below its grid
    plot.plotLayout()->addElement(row, 0, rect_);
    for (QCPAxis* axis : rect_->axes()) {
        axis->setLayer("axes");
        axis->grid()->setLayer("grid");
    }
    time()->grid()->setVisible(true);
    value()->grid()->setVisible(true);
    value()->setNumberFormat("gb");
    value()->setRange(-1e-9, 1e-9);  // an empty one is refused; any data widen it
    now_ = uprightLine(plot, *rect_);
    mouse_ = uprightLine(plot, *rect_);
    instant_ = uprightLine(plot, *rect_);
    mouse_->setVisible(false);
    instant_->setLayer("main");
    instant_->setAntialiased(false);  // one pixel wide, wherever it lies
    unknown_ = new QCPItemRect(&plot);
    unknown_->setLayer("grid");
    unknown_->setClipAxisRect(rect_);
    for (QCPItemPosition* corner : {unknown_->topLeft, unknown_->bottomRight}) placeByTime(*corner, *rect_);
    title_ = new QCPItemText(&plot);
    title_->setLayer("axes");
    title_->setClipToAxisRect(false);
    title_->setPositionAlignment(Qt::AlignLeft | Qt::AlignBottom);  // above the curves' room
    title_->position->setAxisRect(rect_);
    title_->position->setType(QCPItemPosition::ptAxisRectRatio);
    title_->position->setCoords(0, 0);
    title_->setPadding({0, 0, 0, 1});
}

void PlotBand::addCurve(const PlotCurve& curve) {
    if (!curve.expected.isEmpty()) {
        Shaded shaded{&curve, {}};
        for (QCPGraph*& edge : shaded.edges) {
            edge = plot_.addGraph(time(), value());
            edge->setLayer("grid");  // below all curves
            edge->setPen(Qt::NoPen);
        }
        for (const std::size_t low : {0u, 2u}) shaded.edges[low + 1]->setChannelFillGraph(shaded.edges[low]);
        shaded_.push_back(shaded);
    }
    if (!curve.ahead.isEmpty()) ahead_.emplace_back(&curve, plot_.addGraph(time(), value()));
    graphs_.emplace_back(&curve, plot_.addGraph(time(), value()));
}

void PlotBand::addLevel(const PlotLevel& level) { levels_.emplace_back(&level, plot_.addGraph(time(), value())); }

void PlotBand::finish(const QFont& font, bool last) {
    QString quantity = graphs_.front().first->quantity;
    for (const auto& [curve, graph] : graphs_)
        if (curve->quantity != quantity) quantity.clear();
    called_ = titleOf(quantity, unit_);
    time()->setTickLabels(last);
    const int titled = QFontMetrics(font).height() + 1;
    rect_->setMargins({leftMargin, titled, rightMargin, last ? 4 + timeRoom : 4});
    rect_->setMinimumSize(50, least - titled - 4);
    if (last) time()->setLabel(QObject::tr("time (s)"));
}

void PlotBand::setTheme(const Theme& theme, const QFont& font) {
    QColor grid = theme.line;
    grid.setAlpha(theme.dark ? 150 : 130);
    known_ = theme.dark ? theme.surround : QColor(Qt::white);
    rect_->setBackground(known_);
    for (QCPAxis* axis : {time(), value()}) {
        axis->setBasePen(theme.line);
        axis->setTickPen(theme.line);
        axis->setSubTickPen(Qt::NoPen);
        axis->setTickLabelColor(theme.quietText);
        axis->setLabelColor(theme.text);
        axis->setTickLabelFont(font);
        axis->setLabelFont(font);
        axis->grid()->setPen(QPen(grid, 0));
        axis->grid()->setZeroLinePen(QPen(theme.line, 0));
    }
    title_->setFont(font);
    title_->setColor(theme.text);
    title_->setPen(Qt::NoPen);
    now_->setPen(QPen(theme.accent, 2));
    mouse_->setPen(QPen(theme.quietText, 0, Qt::DotLine));
    const QColor leaves = markColour(TimelineMark::Kind::divergence, theme);
    instant_->setPen(QPen(leaves, 1));
    for (const auto& [level, graph] : levels_) graph->setPen(QPen(leaves, 1, Qt::DashLine));
    unknown_->setPen(Qt::NoPen);
    unknown_->setBrush(theme.dark ? theme.panel.lighter(115) : theme.surround);
}

std::pair<double, double> PlotBand::range() const {
    const QCPRange range = value()->range();
    return {range.lower, range.upper};
}

bool PlotBand::has(const QString& curve) const {
    return std::any_of(graphs_.begin(), graphs_.end(), [&](const auto& graph) { return graph.first->id == curve; });
}

QPointF PlotBand::placeOf(double second, double number) const {
    return {time()->coordToPixel(second), value()->coordToPixel(number)};
}

int PlotBand::coveredBy(const QRect& place, const std::function<std::int64_t(double)>& tickAt,
                        const PlotAxis::Time& time) const {
    int covered = 0;
    for (const auto& [curve, graph] : graphs_)
        for (int x = place.left(); x <= place.right(); x += 4) {
            const double number = numberAt(*curve, tickAt(x), time.last);
            if (!std::isfinite(number)) continue;
            const double y = value()->coordToPixel(number);
            covered += y >= place.top() && y <= place.bottom() ? 1 : 0;
        }
    return covered;
}

void PlotBand::fill(const PlotAxis& axis, int bands) {
    // Its quantity and unit are at the end, behind the body's name.
    const QFontMetrics metrics(title_->font());
    const int room = plot_.width() - leftMargin - 2;
    const bool whole = metrics.horizontalAdvance(called_) <= room;
    title_->setText(metrics.elidedText(whole ? called_ : called_.section(": ", -1), Qt::ElideLeft, room));
    Extent extent;
    fillCurves(axis, extent);
    fillAhead(axis, extent);
    fillExpected(axis, extent);
    fillLevels(axis, extent);
    time()->setRange(axis.seconds(axis.from()), axis.seconds(axis.to()));
    value()->ticker()->setTickCount(std::clamp(plot_.height() / bands / 30, 1, 6));
    fitRange(extent);
}

void PlotBand::fillCurves(const PlotAxis& axis, Extent& extent) {
    const double width = std::max(100, plot_.width() - leftMargin - rightMargin);
    const auto step = static_cast<std::int64_t>((axis.to() - axis.from()) / width);
    const auto from = static_cast<std::int64_t>(std::floor(axis.from())) - 1;
    const auto to = static_cast<std::int64_t>(std::ceil(axis.to())) + 1;
    QVector<QPointF> points;
    for (const auto& [curve, graph] : graphs_) {
        points.clear();
        curve->sample(from, to, step, points);
        QPen pen = curvePen(*curve);
        if (step >= dense) pen.setWidthF(0);
        graph->setPen(pen);
        graph->setAntialiased(step < dense);
        QVector<QCPGraphData> drawn;
        drawn.reserve(points.size());
        for (const QPointF& point : points) {
            drawn.append({axis.seconds(point.x()), point.y()});
            extent.include(point.y());
        }
        graph->data()->set(drawn, true);
    }
}

/// From where the run has come to.
void PlotBand::fillAhead(const PlotAxis& axis, Extent& extent) {
    const std::int64_t now = axis.time().last;
    const auto last = static_cast<double>(now);
    for (const auto& [curve, graph] : ahead_) {
        QVector<QCPGraphData> drawn;
        const double joint = curve->at(now);
        if (std::isfinite(joint)) drawn.append({axis.seconds(last), joint});
        for (const QPointF& point : curve->ahead) {
            if (point.x() <= last) continue;
            drawn.append({axis.seconds(point.x()), point.y()});
            extent.include(point.y());
        }
        graph->setPen(aheadPen(*curve, unknown_->visible() ? unknown_->brush().color() : known_));
        graph->data()->set(drawn, true);
    }
}

/// What is shaded may be far wider than the curves: that much of it does not make the axis longer.
void PlotBand::fillExpected(const PlotAxis& axis, Extent& extent) {
    const double size = extent.least <= extent.most ? extent.most - extent.least : 0;
    const double farthest = timesCurves * std::max(size, leastSpan(unit_));
    Extent wider = extent;
    for (const auto& [curve, edges] : shaded_) {
        const ExpectedColours colours = expectedColours(*curve, known_);
        std::array<QVector<QCPGraphData>, 4> drawn;
        for (const ExpectedRange& range : curve->expected) {
            const std::array numbers{range.mostLow, range.mostHigh, range.halfLow, range.halfHigh};
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                drawn[i].append({axis.seconds(range.tick), numbers[i]});
                const bool seen = range.tick >= axis.from() && range.tick <= axis.to();
                if (seen && numbers[i] >= extent.least - farthest && numbers[i] <= extent.most + farthest)
                    wider.include(numbers[i]);
            }
        }
        for (std::size_t i = 0; i < edges.size(); ++i) {
            edges[i]->data()->set(drawn[i], true);
            if (i % 2 == 1) edges[i]->setBrush(i == 1 ? colours.most : colours.half);
        }
    }
    extent = wider;
}

void PlotBand::fillLevels(const PlotAxis& axis, Extent& extent) {
    // Beside a bound many times as large nothing would be seen of the curves.
    const double size = extent.least <= extent.most ? std::max(std::abs(extent.least), std::abs(extent.most)) : 0;
    const double farthest = size > 0 ? timesCurves * size : std::numeric_limits<double>::infinity();
    for (const auto& [level, graph] : levels_) {
        QVector<QCPGraphData> drawn;
        for (const QPointF& point : level->points) {
            drawn.append({axis.seconds(point.x()), point.y()});
            if (std::abs(point.y()) <= std::max(farthest, leastSpan(unit_))) extent.include(point.y());
        }
        if (!drawn.isEmpty()) drawn.append({std::max(drawn.back().key, axis.seconds(axis.to())), drawn.back().value});
        graph->data()->set(drawn, true);
    }
}

void PlotBand::fitRange(const Extent& extent) {
    if (extent.least > extent.most) return;
    const bool fromZero =
        std::all_of(graphs_.begin(), graphs_.end(), [](const auto& graph) { return graph.first->fromZero; });
    const double low = fromZero ? 0 : extent.least;
    const double middle = (low + extent.most) / 2, span = std::max(extent.most - low, leastSpan(unit_));
    const QCPRange now = value()->range();
    // A range that fits stays.
    const double lower = fromZero ? 0 : middle - 0.5 * span, upper = lower + span;
    const bool begins = !fromZero || now.lower == 0;
    if (begins && lower >= now.lower && upper <= now.upper && span > 0.6 * now.size()) return;
    value()->setRange(fromZero ? 0 : lower - 0.08 * span, upper + 0.08 * span);
}

void PlotBand::moveCursors(const PlotAxis& axis, std::optional<std::int64_t> instant) {
    const double last = axis.seconds(static_cast<double>(axis.time().last));
    moveTo(*now_, axis.seconds(static_cast<double>(axis.time().now)));
    unknown_->topLeft->setCoords(last, 0);
    unknown_->bottomRight->setCoords(std::max(last, axis.seconds(axis.to())), 1);
    instant_->setVisible(instant.has_value());
    if (instant) moveTo(*instant_, axis.seconds(static_cast<double>(*instant)));
}

void PlotBand::setMouse(std::optional<double> second) {
    mouse_->setVisible(second.has_value());
    if (second) moveTo(*mouse_, *second);
}

void PlotBand::hideCursors() {
    now_->setVisible(false);
    mouse_->setVisible(false);
    unknown_->setVisible(false);
}

}  // namespace mrose
