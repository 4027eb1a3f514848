#include <QDockWidget>

#include "actions/window_actions.h"
#include "panels/plot_panel.h"
#include "reality/cause_panel.h"
#include "reality/error_plot.h"
#include "reality/overlay_panel.h"
#include "reality/speed_plot.h"
#include "widgets/field_view.h"
#include "widgets/inspector.h"
#include "window/main_window.h"

namespace mrose::gui {
namespace {

/// Of the selected robot, or of all that really drove.
std::vector<ValueKey> errorsOf(const MainWindow& window) {
    std::vector<ValueKey> keys;
    if (window.shown() == nullptr || !window.shown()->frame->reality) return keys;
    const FieldFrame& frame = *window.shown()->frame;
    const std::vector<SceneRobot>& robots = frame.scene().robots;
    const auto selected = window.field().selected();
    for (std::size_t i = 0; i < robots.size(); ++i) {
        if (selected && *selected < robots.size() && selected != i) continue;
        if (frame.reality->robotNamed(robots[i].name) == nullptr) continue;
        const std::vector<ValueKey> errors = errorKeysOf(*frame.reality, robots[i].name);
        keys.insert(keys.end(), errors.begin(), errors.end());
    }
    return keys;
}

}  // namespace

void addPlotActions(MainWindow& window) {
    Actions& actions = window.actions();
    PlotPanel& plots = window.plots();
    Inspector& inspector = window.inspector();
    auto* speeds = new SpeedPlot(window.session(), window.field(), window.plots(), window.overlay());
    const QString menu = QObject::tr("&Plot");
    const auto current = [&window, &inspector] {
        auto key = inspector.currentValue();
        if (!key) window.say(QObject::tr("Choose a number in the inspector first"));
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
                Actions::Asking{[&window, &plots] {
                                    window.showPlots();
                                    plots.askForExpression();
                                    return QString();
                                },
                                [&plots](const QString& text) { return plots.addExpression(text); }});
    actions.add(menu,
                {"plot_speeds", QObject::tr("Plot spee&ds and commands"), QKeySequence("Shift+V"),
                 QObject::tr("The robot's commands, its velocity and the real one's, or no longer")},
                [&window, speeds](bool) {
                    if (!speeds->toggle())
                        window.say(
                            QObject::tr("Nothing real is known beside this robot: open a log, or select "
                                        "one of its robots"));
                });
    window.overlayPanel().causes().offer(actions["plot_speeds"]);
    actions.add(menu,
                {"plot_errors", QObject::tr("Plot &the errors"), QKeySequence("Shift+R"),
                 QObject::tr("How far the selected robot, or all, and overlaid models are from the real ones, or no "
                             "longer")},
                [&window, &plots](bool) {
                    std::vector<ValueKey> errors = errorsOf(window);
                    if (errors.empty()) {
                        window.say(QObject::tr("Nothing real is known beside this: open a log over it first"));
                        return;
                    }
                    const ValueKey first = errors.front();
                    plots.toggleAll(std::move(errors));
                    window.errorPlot().setOn(plots.plotted().count(first) > 0);
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
    QObject::connect(&plots, &PlotPanel::tickRequested, &window.session(),
                     [&window](std::int64_t tick) { window.session().seek(tick, false); });
    QObject::connect(&plots, &PlotPanel::changed, &window,
                     [&plots, &inspector] { inspector.setPlotted(plots.plotted()); });
    QObject::connect(&plots, &PlotPanel::asked, &window, &MainWindow::showPlots);
}

}  // namespace mrose::gui
