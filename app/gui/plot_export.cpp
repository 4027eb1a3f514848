#include "plot_export.h"

#include <QFileInfo>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <thread>

#include "course_walk.h"
#include "evaluation/format.h"
#include "export_outcome.h"
#include "io/file.h"
#include "main_window.h"
#include "plot_panel.h"
#include "view_export.h"

namespace mrose::gui {
namespace {

using Progress = BackgroundWork::Progress;
using Outcome = BackgroundWork::Outcome;

// Of the picture, in pixels of which 96 are an inch: as wide as a page's text.
constexpr int paperInch = 96, paperWidth = 7 * paperInch, bandHeight = 150, axisHeight = 36;
constexpr int paperLeft = 66, paperMargin = 12, legendRow = 19, legendSample = 24, legendGap = 7, legendApart = 20;
constexpr double paperFont = 8.5;  // points

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

std::vector<LegendEntry> legendOf(const std::vector<PlotCurve>& curves, const QString& ghostName, const Theme& theme) {
    std::vector<LegendEntry> legend;
    const PlotCurve* ghost = nullptr;
    for (const PlotCurve& curve : curves) {
        if (curve.ghost) ghost = &curve;
        if (curve.ghost) continue;
        const QString unit = curve.unit.isEmpty() ? QString() : " (" + curve.unit + ')';
        legend.push_back({curve.name.simplified() + unit, curvePen(curve)});
    }
    if (ghost == nullptr) return legend;
    PlotCurve any = *ghost;
    any.colour = theme.text;
    any.style = Qt::SolidLine;
    legend.push_back({QObject::tr("thin: %1").arg(ghostName), curvePen(any)});
    return legend;
}

/// Puts the entries into rows; the height of all.
int placeLegend(std::vector<LegendEntry>& legend, const QFontMetrics& metrics) {
    QPoint at(paperLeft, paperMargin + legendRow / 2);
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

Picture plotPicture(const PlotPanel& plots, const PlotView::Time& time, const QString& title) {
    const Theme theme = paperTheme();
    std::vector<PlotCurve> curves = plots.curvesIn(theme);
    QFont font;
    font.setPointSizeF(paperFont);
    auto legend = legendOf(curves, plots.ghostName(), theme);
    const int top = placeLegend(legend, QFontMetrics(font));
    std::set<QString> units;
    for (const PlotCurve& curve : curves) units.insert(curve.unit);
    const QSize size(paperWidth, bandHeight * static_cast<int>(units.size()) + axisHeight);
    const auto view = std::make_shared<PlotView>();
    view->setTheme(theme);
    view->setCurves(std::move(curves), plots.ghostName());
    view->setTime(time);
    const auto last = static_cast<double>(time.last);
    const PlotView& shown = plots.view();
    view->showRange(std::max(shown.from(), static_cast<double>(time.first)), std::min(shown.to(), last));
    return {{size.width(), size.height() + top}, paperInch, title, [=](QPainter& painter) {
                painter.fillRect(QRect(0, 0, size.width(), size.height() + top), Qt::white);
                painter.setFont(font);
                drawLegend(painter, legend, theme);
                painter.translate(0, top);
                view->paint(painter, size);
            }};
}

/// What is plotted; nothing is an error.
Expected<void> checkPlotted(MainWindow& window) {
    if (window.shown() == nullptr) return fail("", "nothing is open");
    if (window.plots().keys().empty())
        return fail("", "nothing is plotted: choose a number in the inspector, or write an expression");
    return {};
}

/// A course whose numbers are written.
struct CourseColumns {
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
    std::vector<CourseColumns> courses;
    Nanoseconds tickLength = 0;
};

/// Reads all values of a course, tick by tick.
class ValueReader {
public:
    ValueReader(const ValueTable& table, CourseColumns& course) : table_(table), course_(course) {
        course.columns.resize(table.keys.size());
    }

    void read(const TimeTravel& travel, const Cursor& at) {
        const Scenario& scenario = *travel.record(at.branch()).course().scenario;
        if (scenario_ != &scenario) {
            scenario_ = &scenario;
            values_.clear();
            for (const ValueKey& key : table_.keys)
                values_.push_back(plottedValue(scenario, key).value_or(PlottedValue{}));
        }
        Moment moment = at.moment(scenario);
        moment.reality = travel.reality().get();
        for (std::size_t i = 0; i < values_.size(); ++i)
            course_.columns[i].push_back(values_[i].read ? values_[i].read(moment)
                                                         : std::numeric_limits<double>::quiet_NaN());
    }

private:
    const ValueTable& table_;
    CourseColumns& course_;
    const Scenario* scenario_ = nullptr;
    std::vector<PlottedValue> values_;
};

std::string tableText(const ValueTable& table) {
    std::string text = "time_s,tick";
    std::int64_t first = std::numeric_limits<std::int64_t>::max(), end = std::numeric_limits<std::int64_t>::min();
    for (const CourseColumns& course : table.courses) {
        for (const QString& name : table.names) text += ',' + csvCell((name + course.label).toStdString());
        first = std::min(first, course.first);
        end = std::max(end, course.end());
    }
    text += '\n';
    for (std::int64_t tick = first; tick < end; ++tick) {
        text += secondsText(tick * table.tickLength, 2) + ',' + std::to_string(tick);
        for (const CourseColumns& course : table.courses)
            for (std::size_t column = 0; column < course.columns.size(); ++column) {
                const double number = course.at(column, tick);
                text += ',';
                if (std::isfinite(number)) text += exact(number);
            }
        text += '\n';
    }
    return text;
}

Outcome writeValues(ValueTable table, Session& session, const std::string& path, const Progress& progress) {
    double share = 0;
    const auto goesOn = [&] { return progress(share); };
    const double part = 1.0 / static_cast<double>(table.courses.size());
    for (std::size_t i = 0; i < table.courses.size(); ++i) {
        CourseColumns& course = table.courses[i];
        CourseWalk walk(session, table.run, course.branch);
        const auto span = walk.known(goesOn);
        if (!span) return tl::unexpected(span.error());
        if (!*span) return false;
        const std::int64_t first = (*span)->first;
        course.first = first;
        std::vector<std::int64_t> ticks(static_cast<std::size_t>((*span)->last - first + 1));
        std::iota(ticks.begin(), ticks.end(), first);
        ValueReader reader(table, course);
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

Expected<void> exportPlots(MainWindow& window, const QString& path) {
    if (auto plotted = checkPlotted(window); !plotted) return plotted;
    if (auto can = checkPicture(path); !can) return can;
    const auto settled = [&window](const Progress& progress) -> Outcome {
        const auto goesOn = [&] { return progress(0); };
        while (window.plots().series().behind() > 0) {
            if (!goesOn()) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return true;
    };
    const std::function<Expected<void>()> write = [&window, path]() -> Expected<void> {
        // It may have been closed meanwhile.
        if (auto plotted = checkPlotted(window); !plotted) return plotted;
        window.plots().settle();
        return writePicture(plotPicture(window.plots(), window.plots().view().time(), window.windowTitle()), path);
    };
    return exportInBackground(window, {QObject::tr("Exporting %1").arg(path), path},
                              [&window, settled, write](const Progress& progress) -> Outcome {
                                  if (auto there = settled(progress); !there || !*there) return there;
                                  const auto written =
                                      askWindow<Expected<void>>(window, write, [&] { return progress(0.9); });
                                  if (!written) return false;
                                  if (!*written) return tl::unexpected(written->error());
                                  return true;
                              });
}

Expected<void> exportValues(MainWindow& window, const QString& path) {
    if (auto plotted = checkPlotted(window); !plotted) return plotted;
    const std::string file = path.toStdString();
    if (QFileInfo(path).suffix().toLower() != "csv")
        return fail(file, "is no table that can be written; expected .csv");
    if (auto can = checkWritable(file); !can) return can;
    const Shown& shown = *window.shown();
    ValueTable table;
    table.run = shown.run;
    table.keys = window.plots().keys();
    table.tickLength = shown.frame->scene().tickLength;
    for (const ValueKey& key : table.keys) {
        const PlottedValue value = plottedValue(*shown.frame->scenario, key).value_or(PlottedValue{});
        table.names.push_back(value.name.simplified() + (value.unit.isEmpty() ? "" : " (" + value.unit + ')'));
    }
    table.courses.push_back({shown.branch});
    if (const auto ghost = window.plots().ghostBranch())
        table.courses.push_back({*ghost, " [" + window.plots().ghostName() + ']'});
    return exportInBackground(window, {QObject::tr("Exporting %1").arg(path), path},
                              [table = std::move(table), &session = window.session(), file](const Progress& progress) {
                                  return writeValues(table, session, file, progress);
                              });
}

}  // namespace mrose::gui
