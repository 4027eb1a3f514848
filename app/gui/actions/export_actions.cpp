#include "actions/window_actions.h"
#include "export/film_dialog.h"
#include "export/plot_export.h"
#include "export/report_dialog.h"
#include "export/sequence_export.h"
#include "files/window_files.h"
#include "frame/actions.h"
#include "panels/plot_panel.h"

namespace mrose::gui {
namespace {

/// A name with an extension of its kind; empty where nothing is plotted, which is reported.
QString askForPlotFile(const Exports& exports, const QString& title, const QString& kinds, const QString& ending) {
    if (exports.plots.keys().empty()) {
        exports.frame.say(
            QObject::tr("Nothing is plotted yet: choose a number in the inspector, or write an expression"));
        return {};
    }
    return exports.files.saver().askForName(exports.frame.window, title, kinds, ending);
}

void addPlotExports(const Exports& exports, const QString& menu) {
    Actions& actions = exports.frame.actions;
    actions.add(menu,
                {"export_plots", QObject::tr("&Plots as picture\u2026"), QKeySequence("Ctrl+Shift+P"),
                 QObject::tr("The plots for paper, with a legend, as PDF, SVG or PNG")},
                Actions::Asking{[&] {
                                    return askForPlotFile(exports, QObject::tr("Export plots"),
                                                          QObject::tr("Pictures (*.pdf *.svg *.png)"), "_plots.pdf");
                                },
                                [&](const QString& path) { return exportPlots(exports, path); }});
    actions.add(
        menu,
        {"export_values", QObject::tr("Plotted &values\u2026"), QKeySequence("Ctrl+Shift+V"),
         QObject::tr("Every number of what is plotted, of each tick, with the bound, as CSV; ahead is 1 of what "
                     "is pale")},
        Actions::Asking{[&] {
                            return askForPlotFile(exports, QObject::tr("Export values"), QObject::tr("Tables (*.csv)"),
                                                  "_values.csv");
                        },
                        [&](const QString& path) { return exportValues(exports, path); }});
}

void addSequenceExports(const Exports& exports, const QString& menu) {
    Actions& actions = exports.frame.actions;
    const auto ask = [&exports](bool film) {
        return [&exports, film] {
            showFilmDialog(exports, film);
            return QString();
        };
    };
    actions.add(menu,
                {"export_film", QObject::tr("&Film\u2026"), QKeySequence("Ctrl+Shift+M"),
                 QObject::tr("A stretch of time as a film (MP4)")},
                Actions::Asking{ask(true), [&](const QString& path) { return exportFilm(exports, path); }});
    actions.add(menu,
                {"export_sequence", QObject::tr("&Sequence of pictures\u2026"), QKeySequence("Ctrl+Shift+N"),
                 QObject::tr("A stretch of time as a folder of numbered pictures (PNG)")},
                Actions::Asking{ask(false), [&](const QString& path) { return exportFrames(exports, path); }});
}

void addReportExports(const Exports& exports, const QString& menu) {
    Actions& actions = exports.frame.actions;
    actions.add(menu,
                {"export_report", QObject::tr("&Report of a log and a network\u2026"), QKeySequence("Ctrl+Shift+H"),
                 QObject::tr("How true a learned robot is: the page that `mrose evaluate` writes")},
                Actions::Asking{[&] {
                                    showReportDialog(exports);
                                    return QString();
                                },
                                [](const QString&) -> Expected<void> {
                                    return fail("", "expected a log, a network and a folder");
                                }});
    actions.add(
        menu,
        {"export_comparison", QObject::tr("Report of a log and a s&cenario\u2026"), QKeySequence("Ctrl+Shift+B"),
         QObject::tr("Simulated robots beside the real ones: the page that `mrose compare` writes")},
        Actions::Asking{
            [&] {
                showComparisonDialog(exports);
                return QString();
            },
            [](const QString&) -> Expected<void> { return fail("", "expected a scenario, a log and a folder"); }});
}

}  // namespace

void addExportActions(const Exports& exports) {
    const QString menu = QObject::tr("E&xport");
    addPlotExports(exports, menu);
    exports.frame.actions.addSeparator(menu);
    addSequenceExports(exports, menu);
    exports.frame.actions.addSeparator(menu);
    addReportExports(exports, menu);
}

}  // namespace mrose::gui
