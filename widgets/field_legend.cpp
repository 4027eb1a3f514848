#include "widgets/field_legend.h"

#include <QFontMetricsF>
#include <QObject>
#include <algorithm>
#include <array>

#include "debug/real_robot.h"
#include "widgets/layer_sample.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

constexpr double legendSampleWidth = 34, legendMargin = 10, fromEdge = 12, aboveScale = 20;  // pixels
constexpr double mostLegendRow = 20, leastLegendRow = 14, mostLegendShare = 0.6;
/// So much later it is another moment, and not the same run going on.
constexpr Nanoseconds anotherMoment = 5 * nanosecondsPerSecond;

/// Readings are drawn without their layer, too.
bool isShown(const FieldLayers& layers, FieldLayer layer) {
    return layers.has(layer) || (layer == FieldLayer::readings && layers.has(FieldLayer::reality));
}

bool draws(const FieldFrame& frame, const FieldLayers& layers, FieldLayer layer, const FieldFocus& focus) {
    const auto any = [](const auto& all, auto is) { return std::any_of(all.begin(), all.end(), is); };
    switch (layer) {
        case FieldLayer::headings:
            return !frame.state.robots.empty();
        case FieldLayer::trails:
            return frame.trails.ticks() > 1 || frame.reality;
        case FieldLayer::targets:
            return any(frame.insights, [](const RobotInsight& insight) {
                return std::any_of(insight.decision.annotations.begin(), insight.decision.annotations.end(),
                                   [](const Annotation& note) {
                                       return note.kind == Annotation::Kind::line ||
                                              note.kind == Annotation::Kind::point;
                                   });
            });
        case FieldLayer::sensors:
            for (std::size_t robot = 0; robot < frame.state.robots.size(); ++robot)
                if (!sightsOf(frame.scene().typeOf(robot)).empty()) return true;
            return false;
        case FieldLayer::readings:
            return any(shownLooks(frame, layers, focus), [&](const RobotLooks& of) {
                const auto reports = [](const SensorLook& look) { return look.eye && !look.subjects.empty(); };
                return any(of.simulated, reports) || any(of.real, reports);
            });
        case FieldLayer::laser:
        case FieldLayer::sonar:
        case FieldLayer::infrared:
        case FieldLayer::bumpers:
        case FieldLayer::lineCameras:
            return hasScan(shownScans(frame, layers, focus), layer);
        case FieldLayer::radio:
            return !shownMessages(frame, focus).empty();
        case FieldLayer::contacts:
            return !frame.lastTick.contacts.empty();
        case FieldLayer::predicted:
            return any(frame.predicted, [](const std::vector<Pose>& poses) { return poses.size() > 1; });
        case FieldLayer::uncertainty:
            return focus.bands.tellOf(frame) && !focus.bands.bands->empty();
        case FieldLayer::beliefs:
            return any(frame.insights, [&](const RobotInsight& insight) {
                const bool looked = frame.insights.size() <= mostNames ||
                                    focus.selected == static_cast<std::size_t>(&insight - frame.insights.data());
                return insight.observed && looked;
            });
        case FieldLayer::ghosts:
            return !frame.ghosts.empty();
        case FieldLayer::reality:
            return frame.reality != nullptr;
        case FieldLayer::models:
            return frame.reality && !frame.reality->models.empty();
        default:
            return false;
    }
}

struct LegendRow {
    FieldLayer layer;
    QString text;
    std::optional<std::size_t> model = {};
};

/// Of models one each.
std::vector<LegendRow> legendRows(const FieldFrame& frame, const FieldLegend& legend) {
    std::vector<LegendRow> rows;
    for (const FieldLayerText& text : fieldLayerTexts) {
        if (!legend.lists(text.layer)) continue;
        if (text.layer != FieldLayer::models) rows.push_back({text.layer, QObject::tr(text.name)});
        for (std::size_t m = 0; text.layer == FieldLayer::models && frame.reality && m < frame.reality->models.size();
             ++m)
            rows.push_back({text.layer, qtText(frame.reality->models[m].name), m});
    }
    return rows;
}

/// Rows in columns, so that it is no higher than a share of the picture.
struct LegendGrid {
    std::vector<LegendRow> rows;
    std::size_t inColumn = 1;
    double rowHeight = mostLegendRow, columnWidth = 0;

    LegendGrid(const FieldCanvas& canvas, std::vector<LegendRow> of) : rows(std::move(of)) {
        const QFontMetricsF metrics(plateFont(canvas.painter));
        for (const LegendRow& row : rows) columnWidth = std::max(columnWidth, metrics.horizontalAdvance(row.text));
        columnWidth += legendSampleWidth + 2 * legendMargin;
        const double room = mostLegendShare * canvas.view.size().height() - legendMargin;
        rowHeight = std::clamp(room / static_cast<double>(std::max<std::size_t>(1, rows.size())), leastLegendRow,
                               mostLegendRow);
        const auto fitting = static_cast<std::size_t>(std::max(1.0, room / rowHeight));
        inColumn = std::clamp<std::size_t>(fitting, 1, std::max<std::size_t>(1, rows.size()));
        inColumn = (rows.size() + columns() - 1) / std::max<std::size_t>(1, columns());
    }
    std::size_t columns() const { return (rows.size() + inColumn - 1) / inColumn; }
    QSizeF size() const {
        return {columnWidth * static_cast<double>(columns()) + legendMargin,
                rowHeight * static_cast<double>(inColumn) + legendMargin};
    }
};

double pixelsOf(const QRectF& box) { return box.width() * box.height(); }

/// The corners of the picture in the order in which they are preferred: the lower ones first, since messages lie at the
/// upper edge. In the lower right one, above or beside what lies there, wherever it hides less of the place.
std::array<QRectF, 4> cornersFor(const FieldCanvas& canvas, const FieldFrame& frame, const QSizeF& size,
                                 const QRectF& covered) {
    const QSizeF all = canvas.view.size();
    const double right = all.width() - size.width() - fromEdge, low = all.height() - size.height() - fromEdge;
    QRectF corner(QPointF(right, low), size);
    if (corner.intersects(covered)) {
        const QRectF above = corner.translated(0, covered.top() - 8 - corner.bottom());
        const QRectF aside = corner.translated(covered.left() - 8 - corner.right(), -aboveScale);
        const QRectF place = canvas.view.box(areaOf(frame.scene().environment));
        corner = aside.left() >= legendMargin && pixelsOf(aside & place) < pixelsOf(above & place) ? aside : above;
    }
    return {corner, QRectF(QPointF(fromEdge, low - aboveScale), size), QRectF(QPointF(right, fromEdge), size),
            QRectF(QPointF(fromEdge, fromEdge), size)};
}

/// How much lies below it: square pixels of bodies, of the selected one many times.
double hiddenBelow(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus, const QRectF& box) {
    constexpr double selectedCounts = 20;
    double hidden = 1000 * pixelsOf(box & focus.covered);
    const auto add = [&](const Shape& shape, const Pose& pose, double counts) {
        const double half = canvas.pixels(shape.reach);
        hidden +=
            counts * pixelsOf(box & QRectF(canvas.at(position(pose)) - QPointF(half, half), 2 * QSizeF(half, half)));
    };
    for (std::size_t body = 0; body < frame.scene().bodyCount(); ++body)
        add(frame.scene().shapeOf(body), frame.poseOf(body), focus.selected == body ? selectedCounts : 1);
    for (const RealRobot& real : realRobots(frame)) add(*real.shape, real.pose, 1);
    return hidden;
}

}  // namespace

void FieldLegend::arrange(const FieldCanvas& canvas, const FieldFrame& frame, const FieldLayers& layers,
                          const FieldFocus& focus) {
    const View view{layers, canvas.view.size(), canvas.view.scale(), focus.selected, focus.covered};
    const std::int64_t passed = frame.state.tick - tick_;
    const bool another =
        view_ != view || of_.lock() != frame.scenario || passed < 0 || frame.scene().timeOf(passed) > anotherMoment;
    view_ = view;
    of_ = frame.scenario;
    tick_ = frame.state.tick;
    if (another) drawn_.reset();
    for (std::size_t i = 0; i < drawn_.size(); ++i)
        if (const auto layer = static_cast<FieldLayer>(i); isShown(layers, layer) && draws(frame, layers, layer, focus))
            drawn_.set(i);
    const LegendGrid grid(canvas, legendRows(frame, *this));
    box_ = {};
    if (grid.rows.empty()) return;
    const std::array<QRectF, 4> corners = cornersFor(canvas, frame, grid.size(), focus.covered);
    if (another || grid.size() != size_) {
        constexpr double upper = 3000;  // square pixels: a robot or two
        double least = 0;
        for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
            const double hidden =
                hiddenBelow(canvas, frame, focus, corners[static_cast<std::size_t>(i)]) + (i > 1 ? upper : 0);
            if (i == 0 || hidden < least) corner_ = i, least = hidden;
        }
    }
    size_ = grid.size();
    box_ = corners[static_cast<std::size_t>(corner_)];
}

void FieldLegend::draw(const FieldCanvas& canvas, const FieldFrame& frame) const {
    if (box_.isEmpty()) return;
    const LegendGrid grid(canvas, legendRows(frame, *this));
    constexpr double sampleWidth = legendSampleWidth, margin = legendMargin;
    QPainter& painter = canvas.painter;
    painter.setPen(roundPen(canvas.theme.line, 1));
    painter.setBrush(withAlpha(canvas.theme.panel, 235));
    painter.drawRoundedRect(box_, 5, 5);
    for (std::size_t i = 0; i < grid.rows.size(); ++i) {
        const LegendRow& one = grid.rows[i];
        const std::size_t column = i / grid.inColumn, row = i % grid.inColumn;
        const double left = box_.left() + margin + grid.columnWidth * static_cast<double>(column);
        const double top = box_.top() + margin / 2 + grid.rowHeight * static_cast<double>(row);
        const QRectF sample(left, top + 2, sampleWidth, grid.rowHeight - 4);
        if (one.model)
            drawModelSample(painter, sample, *one.model);
        else
            drawSample(painter, sample, one.layer, canvas.theme);
        painter.setFont(plateFont(painter));
        painter.setPen(canvas.theme.text);
        painter.drawText(
            QRectF(left + sampleWidth + margin, top, grid.columnWidth - sampleWidth - margin, grid.rowHeight),
            Qt::AlignLeft | Qt::AlignVCenter, one.text);
    }
}

}  // namespace mrose
