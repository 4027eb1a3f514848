#include <QDockWidget>

#include "actions/window_actions.h"
#include "frame/actions.h"
#include "panels/plot_panel.h"
#include "reality/cause_panel.h"
#include "reality/error_plot.h"
#include "reality/overlay_panel.h"
#include "reality/speed_plot.h"
#include "widgets/field_view.h"
#include "widgets/inspector.h"

namespace mrose::gui {
namespace {

/// Of the selected robot, or of all that really drove.
std::vector<ValueKey> errorsOf(const WindowFrame& frame, const FieldView& field) {
    std::vector<ValueKey> keys;
    if (frame.shown() == nullptr || !frame.shown()->frame->reality) return keys;
    const FieldFrame& now = *frame.shown()->frame;
    const std::vector<SceneRobot>& robots = now.scene().robots;
    const auto selected = field.selected();
    for (std::size_t i = 0; i < robots.size(); ++i) {
        if (selected && *selected < robots.size() && selected != i) continue;
        if (now.reality->robotNamed(robots[i].name) == nullptr) continue;
        const std::vector<ValueKey> errors = errorKeysOf(*now.reality, robots[i].name);
        keys.insert(keys.end(), errors.begin(), errors.end());
    }
    return keys;
}

}  // namespace

void addPlotActions(const WindowFrame& frame, FieldView& field, PlotPanel& plots, Inspector& inspector,
                    Overlay& overlay, OverlayPanel& panel, ErrorPlot& errorPlot) {
    Actions& actions = frame.actions;
    auto* speeds = new SpeedPlot(frame.session, field, plots, overlay);
    const QString menu = QObject::tr("&Plot");
    const auto current = [&frame, &inspector] {
        auto key = inspector.currentValue();
        if (!key) frame.say(QObject::tr("Choose a number in the inspector first"));
        return key;
    };
    actions.add(menu,
                {"plot_value", QObject::tr("Plot the inspector's &value"), QKeySequence("U"),
                 QObject::tr("The number chosen in the inspector over time, or no longer")},
                [&plots, current](bool) {
                    if (const auto key = current()) plots.toggle(*key);
                });
    actions.add(menu,
                {"plot_value_of_all", QObject::tr("Plot it of all &robots"), QKeySequence("Shift+U"),
                 QObject::tr("The number chosen in the inspector, of every robot")},
                [&plots, current](bool) {
                    if (const auto key = current()) plots.toggleOfAll(*key);
                });
    actions.add(menu,
                {"plot_expression", QObject::tr("Plot an &expression\u2026"), QKeySequence("Ctrl+U"),
                 QObject::tr("Any number of the world over time, such as distance(robot[2], ball)")},
                Actions::Asking{[&frame, &plots] {
                                    frame.showDock("plots");
                                    plots.askForExpression();
                                    return QString();
                                },
                                [&plots](const QString& text) { return plots.addExpression(text); }});
    actions.add(menu,
                {"plot_speeds", QObject::tr("Plot spee&ds and commands"), QKeySequence("Shift+V"),
                 QObject::tr("The robot's commands, its velocity and the logged one's, or no longer")},
                [&frame, speeds](bool) {
                    if (!speeds->toggle())
                        frame.say(
                            QObject::tr("No log is known beside this robot: open one, or select "
                                        "one of its robots"));
                });
    panel.causes().offer(actions["plot_speeds"]);
    actions.add(menu,
                {"plot_errors", QObject::tr("Plot &the errors"), QKeySequence("Shift+R"),
                 QObject::tr("How far the selected robot, or all, and overlaid models are from the log, or no "
                             "longer")},
                [&](bool) {
                    std::vector<ValueKey> errors = errorsOf(frame, field);
                    if (errors.empty()) {
                        frame.say(QObject::tr("No log is known beside this: open one over it first"));
                        return;
                    }
                    const ValueKey first = errors.front();
                    plots.toggleAll(std::move(errors));
                    errorPlot.setOn(plots.plotted().count(first) > 0);
                });
    actions.addSeparator(menu);
    actions.add(menu,
                {"plot_all_time", QObject::tr("Show &all of the time"), QKeySequence("Ctrl+0"),
                 QObject::tr("The plots from the run's start to where it has come")},
                [&plots](bool) { plots.view().showAll(); });
    actions.add(menu,
                {"stop_plots", QObject::tr("&Stop computing the past"), QKeySequence("Ctrl+Shift+C"),
                 QObject::tr("Leave out what has not been computed of the plots' past")},
                [&plots](bool) { plots.cancel(); });
    actions.add(
        menu,
        {"clear_plots", QObject::tr("&Clear"), QKeySequence("Ctrl+Shift+U"), QObject::tr("Plot nothing any more")},
        [&plots](bool) { plots.clear(); });
    QObject::connect(&inspector, &Inspector::plotRequested, &plots, &PlotPanel::toggle);
    QObject::connect(&inspector, &Inspector::plotOfAllRequested, &plots, &PlotPanel::toggleOfAll);
    QObject::connect(&plots, &PlotPanel::tickRequested, &frame.session,
                     [&frame](std::int64_t tick) { frame.session.seek(tick, false); });
    QObject::connect(&plots, &PlotPanel::changed, &inspector,
                     [&plots, &inspector] { inspector.setPlotted(plots.plotted()); });
    QObject::connect(&plots, &PlotPanel::asked, &plots, [&frame] { frame.showDock("plots"); });
}

}  // namespace mrose::gui
