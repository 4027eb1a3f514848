#include <QApplication>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "command_line.h"
#include "io/file.h"
#include "main_window.h"
#include "plot_panel.h"
#include "plugin/plugin_host.h"
#include "qt_messages.h"
#include "shared/plugin_process.h"
#include "shortcut_sheet.h"
#include "widgets/field_view.h"
#include "window_actions.h"
#include "window_script.h"

namespace {

using namespace mrose;
using namespace mrose::gui;

int report(const Error& error) {
    std::fprintf(stderr, "mrose-gui: %s\n", error.message().c_str());
    return 1;
}

void settle(MainWindow& window) {
    window.session().settle();
    QApplication::processEvents();
    window.plots().series().settle();
    QApplication::processEvents();
}

/// What is there before anything runs: the run, and how it is looked at.
Expected<void> open(MainWindow& window, const CommandLine& line) {
    if (line.size) window.resize(line.size->first, line.size->second);
    if (line.dark) window.actions()["dark"].setChecked(true), window.setTheme(Theme::darkOne());
    const auto run = openRun(line.file.empty() ? "soccer.toml" : line.file, line.seed);
    if (!run) return tl::unexpected(run.error());
    window.show(*run);
    window.QWidget::show();
    settle(window);
    if (line.speed) window.setSpeed(*line.speed);
    if (!line.layers.empty())
        for (const FieldLayerText& layer : fieldLayerTexts) {
            const std::string name = std::string(layer.action).substr(std::string("layer_").size());
            const bool shown = std::find(line.layers.begin(), line.layers.end(), name) != line.layers.end();
            window.actions()[layer.action].setChecked(shown);
        }
    if (line.at) window.session().seek(window.shown()->frame->scene().ticksOf(fromSeconds(*line.at)));
    settle(window);
    return {};
}

Expected<void> select(MainWindow& window, const std::string& text) {
    const auto body = bodyCalled(*window.shown()->frame, text);
    if (!body) return fail("--select " + text, body.error().cause);
    window.field().setSelected(*body);
    return {};
}

/// To the end that the command line gives: at a speed, or as fast as it goes.
void runToEnd(MainWindow& window, const CommandLine& line) {
    const FieldFrame& frame = *window.shown()->frame;
    const Nanoseconds duration = line.duration ? fromSeconds(*line.duration) : frame.scenario->parts().duration;
    const std::int64_t end = frame.state.tick + line.ticks.value_or(frame.scene().ticksOf(duration));
    if (line.speed.value_or(0) > 0) {
        window.session().play();
        settle(window);
        while (window.shown()->playing && window.shown()->tick() < end)
            QApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents, 20);
        window.session().pause();
    }
    window.session().seek(end);
    settle(window);
}

/// Whether all held.
Expected<bool> script(MainWindow& window, const std::string& path) {
    const auto text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    const auto outcome = runScript(window, *text, path,
                                   {[](const std::string& words) { std::puts(words.c_str()), std::fflush(stdout); },
                                    [](const std::string& words) { std::fprintf(stderr, "%s\n", words.c_str()); }});
    if (!outcome) return tl::unexpected(outcome.error());
    if (outcome->failed > 0)
        std::fprintf(stderr, "mrose-gui: %s: %d of %d expectations failed\n", path.c_str(), outcome->failed,
                     outcome->expected);
    return outcome->failed == 0;
}

Expected<void> save(MainWindow& window, const CommandLine& line) {
    if (!line.screenshot.empty() && !window.saveImage(QString::fromStdString(line.screenshot)))
        return fail(line.screenshot, "cannot be written");
    if (line.record.empty()) return {};
    return window.actions().perform("save_recording", QString::fromStdString(line.record));
}

/// With somebody to work with it.
int work(MainWindow& window, const CommandLine& line) {
    if (line.duration) {
        const FieldFrame& frame = *window.shown()->frame;
        const std::int64_t end = frame.state.tick + frame.scene().ticksOf(fromSeconds(*line.duration));
        QObject::connect(&window, &MainWindow::updated, &window, [&window, end, done = false]() mutable {
            if (done || window.shown()->tick() < end) return;
            done = true;
            window.session().pause();
            window.session().seek(end);
        });
    }
    if (line.file.empty()) {
        showFirstSteps(window);
        window.session().play();
    }
    const int status = QApplication::exec();
    if (const auto saved = save(window, line); !saved) return report(saved.error());
    return status;
}

int runWindow(const CommandLine& line) {
    if (!line.screenshot.empty())
        if (const auto free = checkWritable(line.screenshot); !free) return report(free.error());
    if (!line.record.empty())
        if (const auto free = checkWritable(line.record, line.overwrite); !free) return report(free.error());
    MainWindow window;
    if (line.printKeys) {
        std::fputs(shortcutText(shortcutGroups(window.actions())).toUtf8().constData(), stdout);
        return 0;
    }
    if (const auto opened = open(window, line); !opened) return report(opened.error());
    if (!line.select.empty() && line.interactive())
        if (const auto selected = select(window, line.select); !selected) return report(selected.error());
    if (line.interactive()) return work(window, line);
    window.actions().setUnattended(true);
    if (line.run || (line.script.empty() && line.screenshot.empty())) runToEnd(window, line);
    if (!line.select.empty())
        if (const auto selected = select(window, line.select); !selected) return report(selected.error());
    bool held = true;
    if (!line.script.empty()) {
        const auto done = script(window, line.script);
        if (!done) return report(done.error());
        held = *done;
    }
    settle(window);
    if (const auto saved = save(window, line); !saved) return report(saved.error());
    if (line.printHash) std::printf("state %s\n", stateText(*window.shown()).c_str());
    return held ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::string(argv[1]) == pluginHostWord) {
        servePlugin(std::atoi(argv[2]));
        return 0;
    }
    const auto [line, status] = parseCommandLine(argc, argv);
    if (status) return *status;
    handleQtMessages();
    if (line.offscreen || line.printKeys) qputenv("QT_QPA_PLATFORM", "offscreen");
    int count = 1;  // Qt's own flags are none of ours
    QApplication app(count, argv);
    windowSystemFound();
    QApplication::setStyle("Fusion");
    QApplication::setOrganizationName("mrose");
    QApplication::setApplicationName("mrose-gui");
    try {
        return runWindow(line);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mrose-gui: %s\n", error.what());
        return 1;
    }
}
