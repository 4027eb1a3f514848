#include "export/plot_export.h"

#include <QFileInfo>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <thread>

#include "debug/real_robot.h"
#include "export/export_outcome.h"
#include "export/view_export.h"
#include "frame/actions.h"
#include "io/file.h"
#include "io/format.h"
#include "panels/plot_panel.h"
#include "session/lineage_walk.h"
#include "widgets/qt_text.h"
#include "widgets/timeline_glyphs.h"
#include "world/seconds_text.h"

namespace mrose::gui {
namespace {

using Outcome = BackgroundWork::Outcome;

// Of the picture, in pixels of which 96 are an inch: as wide as a page's text.
constexpr int paperInch = 96, paperWidth = 7 * paperInch, bandHeight = 150, axisHeight = 36;
constexpr int paperLeft = 46, paperMargin = 12, legendRow = 19, legendSample = 24, legendGap = 7, legendApart = 20;
constexpr double paperFont = 8.5, titleFont = 9.5;  // points

/// In a picture for paper nothing is grey that can be white.
Theme paperTheme() {
    Theme theme = Theme::light();
    theme.panel = Qt::white;
    return theme;
}

struct LegendEntry {
    QString text;
    QPen pen;
    QPoint at = {};  ///< its left end and middle
};

/// `goesOn`: beyond what is simulated. A line for each look: on another axis the same one means the same.
std::vector<LegendEntry> legendOf(const std::vector<PlotCurve>& curves, const QString& ghostName, bool goesOn,
                                  const Theme& theme) {
    std::vector<LegendEntry> legend;
    const PlotCurve* ghost = nullptr;
    for (const PlotCurve& curve : curves) {
        if (curve.ghost) ghost = &curve;
        LegendEntry entry{curve.label.isEmpty() ? curve.name.simplified() : curve.label, curvePen(curve)};
        const bool there = std::any_of(legend.begin(), legend.end(), [&](const LegendEntry& other) {
            return other.text == entry.text && other.pen == entry.pen;
        });
        if (!curve.ghost && !there) legend.push_back(std::move(entry));
    }
    const auto isAhead = [](const PlotCurve& curve) { return !curve.ahead.isEmpty(); };
    if (const auto ahead = std::find_if(curves.begin(), curves.end(), isAhead); goesOn && ahead != curves.end())
        legend.push_back({QObject::tr("pale: not yet simulated"), aheadPen(*ahead, Qt::white)});
    for (const PlotCurve* const shaded : shadedOf(curves, false))
        legend.push_back({QObject::tr("50 % of runs, fainter: 90 %"), expectedPen(*shaded, Qt::white)});
    if (ghost == nullptr) return legend;
    PlotCurve any = *ghost;
    any.colour = theme.text;
    any.style = Qt::SolidLine;
    legend.push_back({QObject::tr("thin: %1").arg(ghostName), curvePen(any)});
    return legend;
}

/// What curves are held against, where it is drawn.
void addReferences(std::vector<LegendEntry>& legend, const Exports& exports, const Theme& theme) {
    const PlotPanel& plots = exports.plots;
    const QColor colour = markColour(TimelineMark::Kind::divergence, theme);
    if (!plots.levels().empty()) legend.push_back({QObject::tr("bound"), QPen(colour, 1, Qt::DashLine)});
    if (plots.view().instant())
        legend.push_back({QObject::tr("upright: leaves the %1 trajectory").arg(realWord(*exports.frame.shown()->frame)),
                          QPen(colour, 1)});
}

/// What was driven, and by whom if it is one.
QString headingOf(const Exports& exports) {
    const PlotPanel& plots = exports.plots;
    const PlotView::Time& time = plots.view().axis().time();
    QString heading = qtText(exports.frame.session.runName());
    if (time.end > 0) heading += QObject::tr(" for %1 s").arg(toSeconds(time.end * time.tickLength), 0, 'f', 1);
    std::set<std::string> bodies;
    for (const ValueKey& key : plots.keys()) bodies.insert(key.body);
    if (bodies.size() == 1 && !bodies.begin()->empty()) heading += ", " + qtText(*bodies.begin());
    return heading;
}

/// Puts the entries into rows; the height of all.
int placeLegend(std::vector<LegendEntry>& legend, const QFontMetrics& metrics) {
    QPoint at(paperLeft, paperMargin + legendRow + legendRow / 2);  // below the heading
    for (LegendEntry& entry : legend) {
        const int width = legendSample + legendGap + metrics.horizontalAdvance(entry.text);
        if (at.x() > paperLeft && at.x() + width > paperWidth - paperMargin) at = {paperLeft, at.y() + legendRow};
        entry.at = at;
        at.rx() += width + legendApart;
    }
    return at.y() + legendRow / 2 + legendGap;
}

void drawLegend(QPainter& painter, const std::vector<LegendEntry>& legend, const Theme& theme) {
    painter.setRenderHint(QPainter::Antialiasing);
    for (const LegendEntry& entry : legend) {
        painter.setPen(entry.pen);
        painter.drawLine(entry.at, entry.at + QPoint(legendSample, 0));
        painter.setPen(theme.text);
        painter.drawText(
            QRect(entry.at + QPoint(legendSample + legendGap, -legendRow / 2), QSize(paperWidth, legendRow)),
            Qt::AlignLeft | Qt::AlignVCenter, entry.text);
    }
}

Picture plotPicture(const Exports& exports) {
    const PlotPanel& plots = exports.plots;
    const PlotView& shown = plots.view();
    const PlotView::Time& time = shown.axis().time();
    const Theme theme = paperTheme();
    std::vector<PlotCurve> curves = plots.curvesIn(theme);
    QFont font;
    font.setPointSizeF(paperFont);
    auto legend = legendOf(curves, plots.ghostName(), time.last < time.end, theme);
    std::set<QString> units;
    for (const PlotCurve& curve : curves) units.insert(curve.unit);
    addReferences(legend, exports, theme);
    const int top = placeLegend(legend, QFontMetrics(font));
    QFont bold = font;
    bold.setBold(true);
    bold.setPointSizeF(titleFont);
    const QString heading = headingOf(exports);
    const QSize size(paperWidth, bandHeight * static_cast<int>(units.size()) + axisHeight);
    const auto view = std::make_shared<PlotView>();
    view->setTheme(theme);
    view->setCurves(std::move(curves), plots.ghostName());
    view->setReferences(shown.levels(), shown.instant());
    view->setTime(time);
    const auto last = static_cast<double>(std::max(time.last, time.end));
    view->showRange(std::max(shown.axis().from(), static_cast<double>(time.first)), std::min(shown.axis().to(), last));
    return {{size.width(), size.height() + top}, paperInch, exports.frame.window.windowTitle(), [=](QPainter& painter) {
                painter.fillRect(QRect(0, 0, size.width(), size.height() + top), Qt::white);
                painter.setPen(theme.text);
                painter.setFont(bold);
                painter.drawText(QRect(paperLeft, paperMargin / 2, paperWidth - paperLeft, legendRow),
                                 Qt::AlignLeft | Qt::AlignVCenter, heading);
                painter.setFont(font);
                drawLegend(painter, legend, theme);
                painter.translate(0, top);
                view->paint(painter, size);
            }};
}

/// What is plotted; nothing is an error.
Expected<void> checkPlotted(const Exports& exports) {
    if (exports.frame.shown() == nullptr) return fail("", "nothing is open");
    if (exports.plots.keys().empty())
        return fail("", "nothing is plotted: choose a number in the inspector, or write an expression");
    return {};
}

/// A branch whose numbers are written, with those that it came from.
struct LineageColumns {
    std::uint32_t branch = 0;
    QString label = {};      ///< behind the curves' names
    std::int64_t first = 0;  ///< tick of the first row
    std::vector<std::vector<double>> columns = {};

    double at(std::size_t column, std::int64_t tick) const {
        const std::vector<double>& numbers = columns[column];
        const bool known = tick >= first && tick < first + static_cast<std::int64_t>(numbers.size());
        return known ? numbers[static_cast<std::size_t>(tick - first)] : std::numeric_limits<double>::quiet_NaN();
    }
    std::int64_t end() const { return first + static_cast<std::int64_t>(columns.front().size()); }
};

struct ValueTable {
    std::uint64_t run = 0;
    std::vector<ValueKey> keys;
    std::vector<QString> names;  ///< with units
    std::vector<LineageColumns> lineages;
    Nanoseconds tickLength = 0;
    std::vector<QVector<QPointF>> ahead;  ///< PlotCurve::ahead of each of the shown branch's columns
    std::vector<PlotLevel> levels;        ///< what some of them are held against
    std::optional<std::int64_t> instant;  ///< at which they left that
    std::string real;                     ///< realWord()
};

/// Reads all values of a branch, tick by tick.
class ValueReader {
public:
    ValueReader(const ValueTable& table, LineageColumns& lineage) : table_(table), lineage_(lineage) {
        lineage.columns.resize(table.keys.size());
    }

    void read(const TimeTravel& travel, const Cursor& at) {
        const Scenario& scenario = *travel.branches().record(at.branch()).setup().scenario;
        if (scenario_ != &scenario) {
            scenario_ = &scenario;
            values_.clear();
            for (const ValueKey& key : table_.keys)
                values_.push_back(plottedValue(scenario, key).value_or(PlottedValue{}));
        }
        const Moment moment = at.moment(scenario, travel.reality().get());
        for (std::size_t i = 0; i < values_.size(); ++i)
            lineage_.columns[i].push_back(values_[i].read ? values_[i].read(moment)
                                                          : std::numeric_limits<double>::quiet_NaN());
    }

private:
    const ValueTable& table_;
    LineageColumns& lineage_;
    const Scenario* scenario_ = nullptr;
    std::vector<PlottedValue> values_;
};

/// A row of the table, of the ticks that are known and of those after them of which something is foreseen.
class TableRow {
public:
    TableRow(const ValueTable& table, std::int64_t tick)
        : table_(table), tick_(tick), ahead_(tick >= table.lineages.front().end()) {}

    std::string text(bool foresees) const {
        std::string text = secondsText(tick_ * table_.tickLength, 2) + ',' + std::to_string(tick_);
        const auto add = [&](double number) { text += std::isfinite(number) ? ',' + numberText(number) : ","; };
        for (const LineageColumns& lineage : table_.lineages)
            for (std::size_t column = 0; column < lineage.columns.size(); ++column)
                add(ahead_ && &lineage == &table_.lineages.front() ? foreseen(table_.ahead[column])
                                                                   : lineage.at(column, tick_));
        for (const PlotLevel& level : table_.levels) add(levelAt(level, static_cast<double>(tick_)));
        if (table_.instant) text += tick_ == *table_.instant ? ",1" : ",0";
        if (foresees) text += ahead_ ? ",1" : ",0";
        return text + '\n';
    }

private:
    double foreseen(const QVector<QPointF>& ahead) const {
        const auto found =
            std::lower_bound(ahead.begin(), ahead.end(), tick_,
                             [](const QPointF& point, std::int64_t at) { return std::llround(point.x()) < at; });
        const bool there = found != ahead.end() && std::llround(found->x()) == tick_;
        return there ? found->y() : std::numeric_limits<double>::quiet_NaN();
    }

    const ValueTable& table_;
    std::int64_t tick_;
    bool ahead_;
};

std::string tableText(const ValueTable& table) {
    std::string text = "time_s,tick";
    std::int64_t first = std::numeric_limits<std::int64_t>::max(), end = std::numeric_limits<std::int64_t>::min();
    for (const LineageColumns& lineage : table.lineages) {
        for (const QString& name : table.names) text += ',' + csvCell((name + lineage.label).toStdString());
        first = std::min(first, lineage.first);
        end = std::max(end, lineage.end());
    }
    std::set<std::int64_t> ahead;
    for (const QVector<QPointF>& points : table.ahead)
        for (const QPointF& point : points)
            if (std::isfinite(point.y()) && point.x() >= static_cast<double>(table.lineages.front().end()))
                ahead.insert(std::llround(point.x()));
    for (const PlotLevel& level : table.levels) text += ',' + csvCell("bound (" + level.unit.toStdString() + ')');
    if (table.instant) text += ",leaves the " + table.real + " trajectory";
    if (!ahead.empty()) text += ",ahead";
    text += '\n';
    const bool foresees = !ahead.empty();
    for (std::int64_t tick = first; tick < end; ++tick) ahead.insert(tick);
    for (const std::int64_t tick : ahead) text += TableRow(table, tick).text(foresees);
    return text;
}

Outcome writeValues(ValueTable table, Session& session, const std::string& path, const Progress& progress) {
    double share = 0;
    const auto goesOn = [&] { return progress(share); };
    const double part = 1.0 / static_cast<double>(table.lineages.size());
    for (std::size_t i = 0; i < table.lineages.size(); ++i) {
        LineageColumns& lineage = table.lineages[i];
        LineageWalk walk(session, table.run, lineage.branch);
        const auto span = walk.known(goesOn);
        if (!span) return tl::unexpected(span.error());
        if (!*span) return false;
        const std::int64_t first = (*span)->first;
        lineage.first = first;
        std::vector<std::int64_t> ticks(static_cast<std::size_t>((*span)->last - first + 1));
        std::iota(ticks.begin(), ticks.end(), first);
        ValueReader reader(table, lineage);
        const auto visit = [&](const TimeTravel& travel, const Cursor& at) {
            reader.read(travel, at);
            share = part * (static_cast<double>(i) +
                            static_cast<double>(at.tick() - first) / static_cast<double>(ticks.size()));
        };
        if (auto done = walk.visit(ticks, visit, goesOn); !done || !*done) return done;
    }
    if (auto written = writeFileAtomically(path, tableText(table)); !written) return tl::unexpected(written.error());
    return true;
}

}  // namespace

Expected<void> exportPlots(const Exports& exports, const QString& path) {
    if (auto plotted = checkPlotted(exports); !plotted) return plotted;
    if (auto can = checkPicture(path); !can) return can;
    const std::function<bool()> known = [&exports] { return exports.plots.series().behind() == 0; };
    const std::function<Expected<void>()> write = [&exports, path]() -> Expected<void> {
        // It may have been closed meanwhile.
        if (auto plotted = checkPlotted(exports); !plotted) return plotted;
        exports.plots.settle();
        return writePicture(plotPicture(exports), path);
    };
    return exportInBackground(exports, {QObject::tr("Exporting %1").arg(path), path},
                              [&exports, known, write](const Progress& progress) -> Outcome {
                                  const auto goesOn = [&] { return progress(0); };
                                  for (std::optional<bool> all = false; !*all;) {
                                      all = askWindow<bool>(exports.frame.window, known, goesOn);
                                      if (!all) return false;
                                      if (!*all) std::this_thread::sleep_for(std::chrono::milliseconds(5));
                                  }
                                  const auto written = askWindow<Expected<void>>(exports.frame.window, write,
                                                                                 [&] { return progress(0.9); });
                                  if (!written) return false;
                                  if (!*written) return tl::unexpected(written->error());
                                  return true;
                              });
}

Expected<void> exportValues(const Exports& exports, const QString& path) {
    if (auto plotted = checkPlotted(exports); !plotted) return plotted;
    const std::string file = path.toStdString();
    if (QFileInfo(path).suffix().toLower() != "csv")
        return fail(file, "is no table that can be written; expected .csv");
    if (auto can = checkWritable(file); !can) return can;
    const Shown& shown = *exports.frame.shown();
    ValueTable table;
    table.run = shown.run;
    table.keys = exports.plots.keys();
    table.tickLength = shown.frame->scene().tickLength;
    table.real = realWord(*shown.frame);
    for (const ValueKey& key : table.keys) {
        const PlottedValue value = plottedValue(*shown.frame->scenario, key).value_or(PlottedValue{});
        const QString unit = qtText(value.unit);
        table.names.push_back(qtText(value.name).simplified() + (unit.isEmpty() ? "" : " (" + unit + ')'));
    }
    for (const PlotCurve& curve : exports.plots.view().curves())
        if (!curve.ghost) table.ahead.push_back(curve.ahead);
    table.levels = exports.plots.levels();
    table.instant = exports.plots.view().instant();
    table.lineages.push_back({shown.branch});
    if (const auto ghost = exports.plots.ghostBranch())
        table.lineages.push_back({*ghost, " [" + exports.plots.ghostName() + ']'});
    return exportInBackground(exports, {QObject::tr("Exporting %1").arg(path), path},
                              [table = std::move(table), &session = exports.frame.session,
                               file](const Progress& progress) { return writeValues(table, session, file, progress); });
}

}  // namespace mrose::gui
