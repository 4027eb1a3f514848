#include <QApplication>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include "actions/window_actions.h"
#include "application.h"
#include "command_line.h"
#include "export/film.h"
#include "export/sequence_export.h"
#include "export/view_export.h"
#include "files/window_files.h"
#include "frame/window_memory.h"
#include "io/file.h"
#include "logs/log_reader.h"
#include "panels/plot_panel.h"
#include "panels/shortcut_sheet.h"
#include "panels/time_bar.h"
#include "plugin/plugin_host.h"
#include "qt_messages.h"
#include "reality/overlay.h"
#include "scripting/window_script.h"
#include "session/background_work.h"
#include "shared/interrupts.h"
#include "widgets/field_view.h"
#include "widgets/fixed_text.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "window/main_window.h"
#include "workflow/plugins.h"
#include "workflow/resources.h"

namespace {

using namespace mrose;
using namespace mrose::gui;

int report(const Error& error) {
    std::fprintf(stderr, "mrose-gui: %s\n", error.message().c_str());
    return 1;
}

OpenRequest requestOf(const CommandLine& line) {
    return {line.file.empty() ? "soccer.toml" : line.file,
            line.trial,
            line.seed,
            line.log,
            line.pluginLimit,
            line.variant,
            line.overrides,
            line.settings};
}

/// A log given as FILE or with --log is laid over its simulation; --run and recordings are opened as they are.
std::optional<PlayedLogRequest> overlayOf(const CommandLine& line) {
    const std::string place = placeOfLog(line.file);
    const bool isLog = !line.file.empty() && looksLikeLog(place);
    if (line.run || (!isLog && line.log.empty())) return {};
    return PlayedLogRequest{isLog ? place : placeOfLog(line.log),
                            isLog ? "" : line.file,
                            line.robotFile,
                            line.robots,
                            line.models,
                            line.seed,
                            line.pluginLimit};
}

/// nullopt: the one that suits the log.
std::optional<RolloutPlan> planOf(const CommandLine& line) {
    if (!line.windows && !line.duration && !line.every && !line.start) return {};
    RolloutPlan plan;
    plan.cut = line.windows                   ? RolloutPlan::Cut::windows
               : line.duration && !line.every ? RolloutPlan::Cut::once
                                              : RolloutPlan::Cut::every;
    plan.start = line.start.value_or(plan.start);
    plan.length = line.every ? *line.every : line.duration.value_or(plan.length);
    if (line.every && line.duration) plan.stretch = line.duration;
    return plan;
}

Expected<void> openNow(MainWindow& window, const CommandLine& line) {
    if (const auto overlay = overlayOf(line)) return window.overlay().openNow(*overlay, planOf(line));
    return window.files().openNow(requestOf(line), line.at);
}

/// How the run is looked at, once it is there.
void look(MainWindow& window, const CommandLine& line) {
    if (line.speed) window.timeBar().setSpeed(*line.speed);
    if (line.layers.empty()) return;
    for (const FieldLayerText& layer : fieldLayerTexts) {
        const std::string name = std::string(layer.action).substr(std::string("layer_").size());
        const bool shown = std::find(line.layers.begin(), line.layers.end(), name) != line.layers.end();
        window.actions()[layer.action].setChecked(shown);
    }
}

Expected<void> select(MainWindow& window, const std::string& text) {
    const auto body = bodyCalled(*window.shown()->frame, text);
    if (!body) return fail("--select " + text, body.error().cause);
    window.field().setSelected(*body);
    return {};
}

/// Error: one does not fit what is open.
Expected<std::vector<Breakpoint>> breakpointsOf(MainWindow& window, const CommandLine& line) {
    std::vector<Breakpoint> breakpoints;
    const Shown& shown = *window.shown();
    for (const std::string& text : line.breaks) {
        if (auto fits = checkBreakText(text, *shown.setup, shown.frame->reality); !fits)
            return fail("--break " + text, wrongWith(fits.error()));
        breakpoints.emplace_back().text = text;
    }
    return breakpoints;
}

/// To the end that the command line gives, or to a break: at a speed, or as fast as it goes.
void runToEnd(MainWindow& window, const CommandLine& line) {
    const FieldFrame& frame = *window.shown()->frame;
    const Nanoseconds duration = line.duration ? fromSeconds(*line.duration) : frame.scenario->parts().duration;
    const std::int64_t end = frame.state.tick + line.ticks.value_or(frame.scene().ticksOf(duration));
    if (line.speed.value_or(0) > 0) {
        window.session().ask([=](Debugger& debugger) { debugger.stopAt(end); });
        window.session().play();
        settle(window.scripted());
        while (window.shown()->playing) letPass(20);
    } else {
        window.session().seek(end, true);
        settle(window.scripted());
    }
    if (line.breaks.empty()) return;
    const Shown& shown = *window.shown();
    const QString none = QObject::tr("no break up to %1").arg(clockText(shown.frame->scene().timeOf(shown.tick())));
    std::puts((shown.atBreak ? qtText(shown.message) : none).toUtf8().constData());
}

/// Whether all held.
Expected<bool> script(MainWindow& window, const std::string& path) {
    const auto text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    const auto outcome = runScript(window.scripted(), *text, path,
                                   {[](const std::string& words) { std::puts(words.c_str()), std::fflush(stdout); },
                                    [](const std::string& words) { std::fprintf(stderr, "%s\n", words.c_str()); }});
    if (!outcome) return tl::unexpected(outcome.error());
    if (outcome->failed > 0)
        std::fprintf(stderr, "mrose-gui: %s: %d of %d expectations failed\n", path.c_str(), outcome->failed,
                     outcome->expected);
    return outcome->failed == 0;
}

/// Its recording whole, and said what went wrong with it.
Expected<void> finishRecording(MainWindow& window) {
    window.files().saver().record({});
    settle(window.scripted());
    if (const QString& error = window.files().saver().recordingError(); !error.isEmpty())
        return fail("", error.toStdString());
    return {};
}

/// What is asked for of the end; the exit status.
int finish(MainWindow& window, const CommandLine& line, bool held) {
    settle(window.scripted());
    if (const auto recorded = finishRecording(window); !recorded) return report(recorded.error());
    if (line.printHash && window.shown()) std::printf("state %s\n", stateText(*window.shown()).c_str());
    return held ? 0 : 1;
}

/// What is done when the run is there and a user works with it.
void begin(MainWindow& window, const CommandLine& line) {
    look(window, line);
    if (const auto breakpoints = breakpointsOf(window, line); !breakpoints)
        window.messages().add({MessageBar::Kind::error, qtText(breakpoints.error().message())});
    else
        for (const Breakpoint& breakpoint : *breakpoints)
            window.session().changeBreakpoints([=](Breakpoints& all) { all.add(breakpoint); });
    if (!line.select.empty())
        if (const auto selected = select(window, line.select); !selected)
            window.messages().add({MessageBar::Kind::error, qtText(selected.error().message())});
    if (!line.record.empty()) window.files().saver().record(qtText(line.record), line.overwrite);
    if (line.duration && !overlayOf(line)) {
        const FieldFrame& frame = *window.shown()->frame;
        const std::int64_t end = frame.state.tick + frame.scene().ticksOf(fromSeconds(*line.duration));
        window.session().ask([end](Debugger& debugger) { debugger.stopAt(end); });
    }
    if (!line.file.empty() || !line.log.empty()) return;
    showFirstSteps(window.actions());
    window.session().play();
}

/// The window is no smaller than what is in it.
void saySize(const MainWindow& window, const CommandLine& line) {
    if (!line.size || (window.width() <= line.size->first && window.height() <= line.size->second)) return;
    std::fprintf(stderr, "mrose-gui: --size %dx%d: the window needs %dx%d at least\n", line.size->first,
                 line.size->second, window.width(), window.height());
}

int work(MainWindow& window, const CommandLine& line) {
    window.QWidget::show();
    saySize(window, line);
    // Until the run is there: who called from a terminal may look there.
    const QMetaObject::Connection said =
        QObject::connect(&window.messages(), &MessageBar::added, [](MessageBar::Kind kind, const QString& text) {
            if (kind == MessageBar::Kind::error) std::fprintf(stderr, "mrose-gui: %s\n", text.toUtf8().constData());
        });
    if (const auto overlay = overlayOf(line))
        window.overlay().open(*overlay, planOf(line));
    else if (line.file.empty())
        window.files().open(requestOf(line), line.at);
    else
        window.files().open(qtText(line.file), requestOf(line), line.at);
    const auto once = std::make_shared<QMetaObject::Connection>();
    *once = QObject::connect(&window.session(), &Session::shown, &window, [&window, &line, once, said] {
        QObject::disconnect(*once);
        begin(window, line);
        QObject::disconnect(said);
    });
    QApplication::exec();
    return finish(window, line, true);
}

std::string firstError(const MainWindow& window) {
    for (const MessageBar::Message& message : window.messages().messages())
        if (message.kind == MessageBar::Kind::error) return message.text.toStdString();
    return {};
}

/// Unattended: to the end that the command line or the script gives.
int runAlone(MainWindow& window, const CommandLine& line) {
    window.actions().setUnattended(true);
    if (const auto opened = openNow(window, line); !opened) return report(opened.error());
    window.QWidget::show();
    settle(window.scripted());
    if (!line.models.empty())
        if (const std::string wrong = firstError(window); !wrong.empty()) return report({"", 0, 0, "", wrong});
    if (line.run && !line.log.empty() && window.shown()->setup->scenario->parts().players.empty())
        return report(Error{"--log " + line.log, 0, 0, "", "is not read: " + line.file + " plays no log"});
    look(window, line);
    // Unattended: only what was asked for stops the run.
    const auto breakpoints = breakpointsOf(window, line);
    if (!breakpoints) return report(breakpoints.error());
    window.session().setBreakpoints(*breakpoints);
    if (!line.record.empty()) window.files().saver().record(qtText(line.record), line.overwrite);
    const bool endGiven = line.ticks || line.duration;
    bool held = true;
    if (line.run ? endGiven || !line.at
                 : endGiven || (line.script.empty() && line.screenshot.empty() && line.film.empty() && !line.at)) {
        runToEnd(window, line);
        // As of `mrose run`; a script says itself what it expects.
        held = !line.script.empty() || window.shown()->faults.empty();
    }
    if (!line.select.empty())
        if (const auto selected = select(window, line.select); !selected) return report(selected.error());
    if (!line.script.empty()) {
        const auto done = script(window, line.script);
        if (!done) return report(done.error());
        held = *done;
    }
    if (line.script.empty()) window.overlay().settle();
    settle(window.scripted());
    for (const MessageBar::Message& message : window.messages().messages())
        std::fprintf(stderr, "mrose-gui: %s\n", message.text.toStdString().c_str());
    saySize(window, line);
    if (!line.screenshot.empty())
        if (const auto saved = writeWidget(window, qtText(line.screenshot)); !saved) return report(saved.error());
    if (!line.film.empty())
        if (const auto made = exportFilm(window.exports(), qtText(line.film)); !made) return report(made.error());
    return finish(window, line, held);
}

/// In a thread of its own, since the window's may be waiting for what takes long. The recording is closed, and what is
/// half exported is removed.
[[noreturn]] void endAtOnce(MainWindow& window) {
    window.session().quit();
    window.background().quit();
    std::fflush(stdout);
    std::_Exit(interruptedStatus());
}

int runWindow(const CommandLine& line) {
    if (line.at && overlayOf(line)) {
        std::fputs("mrose-gui: --at is a time of the run alone; with a log --start says where in it to begin\n",
                   stderr);
        return 2;
    }
    if (const std::string flag = flagOfALog(line); !flag.empty() && !overlayOf(line)) {
        std::fprintf(stderr, "mrose-gui: %s: is for a log over its simulation; name one as FILE or with --log\n",
                     flag.c_str());
        return 2;
    }
    if (!line.screenshot.empty())
        if (const auto free = checkWritable(line.screenshot); !free) return report(free.error());
    if (!line.film.empty())
        if (const auto can = checkFilm(qtText(line.film)); !can) return report(can.error());
    if (!line.record.empty())
        if (const auto free = checkWritable(line.record, line.overwrite); !free) return report(free.error());
    MainWindow window;
    watchInterrupts();
    const OnInterrupt ending([&window] { endAtOnce(window); });
    if (line.printKeys) {
        std::fputs(shortcutText(shortcutGroups(window.actions())).toUtf8().constData(), stdout);
        return 0;
    }
    if (line.interactive() || line.remember) window.frame().memory.restore(WindowMemory::ofUser());
    window.overlay().setFollows(!line.run);
    if (line.size) window.resize(line.size->first, line.size->second);
    if (line.dark && !window.actions()["dark"].isChecked()) window.actions()["dark"].trigger();
    const int status = line.interactive() ? work(window, line) : runAlone(window, line);
    if (line.remember && !line.interactive()) window.frame().memory.save();
    return status;
}

int runProgram(int argc, char** argv) {
    if (argc == 3 && std::string(argv[1]) == pluginHostWord) {
        servePlugin(std::atoi(argv[2]));
        return 0;
    }
    const auto [line, status] = parseCommandLine(argc, argv);
    if (status) return *status;
    handleQtMessages();
    if (line.offscreen || line.printKeys) qputenv("QT_QPA_PLATFORM", "offscreen");
    int count = 1;  // Qt's own flags are none of ours
    const auto app = makeApplication(count, argv);
    windowSystemFound();
    QApplication::setDesktopFileName("mrose");
    QApplication::setWindowIcon(QIcon(qtText((resourceFolder() / "resources" / "mrose.svg").string())));
    QApplication::setOrganizationName("mrose");
    QApplication::setApplicationName("mrose-gui");
    return runWindow(line);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return runProgram(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mrose-gui: %s\n", error.what());
        return 1;
    }
}
