#include <QDockWidget>

#include "main_window.h"
#include "plot_panel.h"
#include "widgets/field_view.h"
#include "widgets/inspector.h"
#include "window_actions.h"

namespace mrose::gui {
namespace {

/// Position and heading errors of the selected robot, or of all that really drove; of the run and of each model.
std::vector<ValueKey> errorsOf(const MainWindow& window) {
    std::vector<ValueKey> keys;
    if (window.shown() == nullptr || !window.shown()->frame->reality) return keys;
    const FieldFrame& frame = *window.shown()->frame;
    const std::vector<SceneRobot>& robots = frame.scene().robots;
    const auto selected = window.field().selected();
    for (std::size_t i = 0; i < robots.size(); ++i) {
        if (selected && *selected < robots.size() && selected != i) continue;
        if (frame.reality->robotNamed(robots[i].name) == nullptr) continue;
        for (const char* quantity : {positionErrorQuantity, headingErrorQuantity}) {
            keys.push_back({quantity, robots[i].name});
            for (const Reality::ModelCourse& model : frame.reality->models)
                keys.push_back({quantity, robots[i].name, model.name});
        }
    }
    return keys;
}

}  // namespace

void addPlotActions(MainWindow& window) {
    Actions& actions = window.actions();
    PlotPanel& plots = window.plots();
    Inspector& inspector = window.inspector();
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
                {"plot_errors", QObject::tr("Plot &the errors"), QKeySequence("Shift+R"),
                 QObject::tr("How far the selected robot, or all, and overlaid models are from the real ones, or no "
                             "longer")},
                [&window, &plots](bool) {
                    std::vector<ValueKey> errors = errorsOf(window);
                    if (errors.empty())
                        window.say(QObject::tr("Nothing real is known beside this: open a log over it first"));
                    else
                        plots.toggleAll(std::move(errors));
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
    QObject::connect(&plots, &PlotPanel::changed, &window, [&window, &plots, &inspector] {
        inspector.setPlotted(plots.plotted());
        if (!plots.keys().empty()) window.showPlots();
    });
}

}  // namespace mrose::gui
