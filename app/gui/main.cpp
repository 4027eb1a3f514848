#include <QAction>
#include <QApplication>
#include <QEventLoop>
#include <QTimer>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "main_window.h"
#include "plugin/plugin_host.h"
#include "shared/plugin_process.h"
#include "widgets/field_view.h"

namespace {

struct Options {
    std::string file, screenshot, run;
    std::int64_t ticks = 0;
    bool offscreen = false, dark = false;
    std::optional<std::size_t> select;
};

int runWindow(QApplication& app, const Options& options) {
    mrose::gui::MainWindow window;
    if (options.dark) window.actions()["dark"].trigger();
    const std::string name = !options.run.empty() ? options.run : !options.file.empty() ? options.file : "soccer.toml";
    if (!window.open(QString::fromStdString(name))) return 1;
    window.QWidget::show();
    if (options.run.empty()) {
        if (options.file.empty()) window.session().play();
        return QApplication::exec();
    }
    window.session().settle();
    window.session().seek(options.ticks);
    window.session().settle();
    if (options.select) window.field().setSelected(options.select);
    app.processEvents();
    if (!options.screenshot.empty() && !window.saveImage(QString::fromStdString(options.screenshot))) {
        std::fprintf(stderr, "mrose-gui: %s: cannot be written\n", options.screenshot.c_str());
        return 1;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::string(argv[1]) == mrose::pluginHostWord) {
        mrose::servePlugin(std::atoi(argv[2]));
        return 0;
    }
    CLI::App cli("The window: run, stop, step, rewind and branch what robots do.", "mrose-gui");
    Options options;
    cli.add_option("FILE", options.file, "Scenario to open");
    cli.add_option("--run", options.run, "Scenario to run for --ticks");
    cli.add_option("--ticks", options.ticks, "How many ticks");
    cli.add_option("--screenshot", options.screenshot, "Where to save a picture of the window");
    cli.add_option("--select", options.select, "Body to select");
    cli.add_flag("--offscreen", options.offscreen, "Without a display");
    cli.add_flag("--dark", options.dark, "Dark colours");
    CLI11_PARSE(cli, argc, argv);
    if (options.offscreen) qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication app(argc, argv);
    QApplication::setStyle("Fusion");
    return runWindow(app, options);
}
