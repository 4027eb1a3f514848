#include "qt_messages.h"

#include <QByteArray>
#include <QString>
#include <QtGlobal>
#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace mrose::gui {
namespace {

std::atomic<bool> searching{false};

bool meansNothing(const QString& text) {
    return text.startsWith("This plugin does not support ") ||
           text.startsWith("QStandardPaths: XDG_RUNTIME_DIR not set");
}

[[noreturn]] void endWithoutDisplay() {
    const QByteArray display = qgetenv("DISPLAY");
    if (display.isEmpty())
        std::fputs("mrose-gui: there is no display (DISPLAY is not set); --offscreen needs none\n", stderr);
    else
        std::fprintf(stderr, "mrose-gui: the display %s cannot be used; --offscreen needs none\n", display.constData());
    std::_Exit(1);
}

void onMessage(QtMsgType type, const QMessageLogContext& /*where*/, const QString& text) {
    if (searching) {
        if (type == QtFatalMsg) endWithoutDisplay();
        if (text.contains("could not connect to display") || text.contains("Could not load the Qt platform plugin"))
            return;
    }
    if (!meansNothing(text)) std::fprintf(stderr, "mrose-gui: %s\n", text.toLocal8Bit().constData());
    if (type == QtFatalMsg) std::abort();
}

}  // namespace

void handleQtMessages() {
    searching = true;
    qInstallMessageHandler(onMessage);
}

void windowSystemFound() { searching = false; }

}  // namespace mrose::gui
