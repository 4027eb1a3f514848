#include <QFileDialog>

#include "actions/window_actions.h"
#include "export/film_dialog.h"
#include "export/plot_export.h"
#include "export/report_dialog.h"
#include "export/sequence_export.h"
#include "files/window_files.h"
#include "panels/plot_panel.h"
#include "window/main_window.h"

namespace mrose::gui {
namespace {

/// A name with an extension of its kind; empty where nothing is plotted, which is reported.
QString askForPlotFile(MainWindow& window, const QString& title, const QString& kinds, const QString& ending) {
    if (window.plots().keys().empty()) {
        window.say(QObject::tr("Nothing is plotted yet: choose a number in the inspector, or write an expression"));
        return {};
    }
    QString path = QFileDialog::getSaveFileName(&window, title, window.files().suggestedName(ending), kinds);
    if (!path.isEmpty() && QFileInfo(path).suffix().isEmpty()) path += ending.mid(ending.lastIndexOf('.'));
    return path;
}

void addPlotExports(MainWindow& window, const QString& menu) {
    Actions& actions = window.actions();
    actions.add(menu,
                {"export_plots", QObject::tr("&Plots as picture\u2026"), QKeySequence("Ctrl+Shift+P"),
                 QObject::tr("The plots for paper, with a legend, as PDF, SVG or PNG")},
                Actions::Asking{[&] {
                                    return askForPlotFile(window, QObject::tr("Export plots"),
                                                          QObject::tr("Pictures (*.pdf *.svg *.png)"), "_plots.pdf");
                                },
                                [&](const QString& path) { return exportPlots(window, path); }});
    actions.add(
        menu,
        {"export_values", QObject::tr("Plotted &values\u2026"), QKeySequence("Ctrl+Shift+V"),
         QObject::tr("Every number of what is plotted, of each tick, with the bound, as CSV; ahead is 1 of what "
                     "is pale")},
        Actions::Asking{[&] {
                            return askForPlotFile(window, QObject::tr("Export values"), QObject::tr("Tables (*.csv)"),
                                                  "_values.csv");
                        },
                        [&](const QString& path) { return exportValues(window, path); }});
}

void addSequenceExports(MainWindow& window, const QString& menu) {
    Actions& actions = window.actions();
    const auto ask = [&window](bool film) {
        return [&window, film] {
            showFilmDialog(window, film);
            return QString();
        };
    };
    actions.add(menu,
                {"export_film", QObject::tr("&Film\u2026"), QKeySequence("Ctrl+Shift+M"),
                 QObject::tr("A stretch of time as a film (MP4)")},
                Actions::Asking{ask(true), [&](const QString& path) { return exportFilm(window, path); }});
    actions.add(menu,
                {"export_sequence", QObject::tr("&Sequence of pictures\u2026"), QKeySequence("Ctrl+Shift+N"),
                 QObject::tr("A stretch of time as a folder of numbered pictures (PNG)")},
                Actions::Asking{ask(false), [&](const QString& path) { return exportFrames(window, path); }});
}

void addReportExports(MainWindow& window, const QString& menu) {
    Actions& actions = window.actions();
    actions.add(menu,
                {"export_report", QObject::tr("&Report of a log and a network\u2026"), QKeySequence("Ctrl+Shift+H"),
                 QObject::tr("How true a learned robot is: the page that `mrose evaluate` writes")},
                Actions::Asking{[&] {
                                    showReportDialog(window);
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
                showComparisonDialog(window);
                return QString();
            },
            [](const QString&) -> Expected<void> { return fail("", "expected a scenario, a log and a folder"); }});
}

}  // namespace

void addExportActions(MainWindow& window) {
    const QString menu = QObject::tr("E&xport");
    addPlotExports(window, menu);
    window.actions().addSeparator(menu);
    addSequenceExports(window, menu);
    window.actions().addSeparator(menu);
    addReportExports(window, menu);
}

}  // namespace mrose::gui
