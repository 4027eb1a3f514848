#include <QDesktopServices>
#include <QMessageBox>
#include <QSettings>
#include <QUrl>
#include <utility>

#include "actions/first_steps.h"
#include "actions/window_actions.h"
#include "frame/actions.h"
#include "panels/shortcut_sheet.h"
#include "reality/overlay.h"
#include "widgets/qt_text.h"
#include "workflow/resources.h"
#include "workflow/version.h"

namespace mrose::gui {
namespace {

constexpr const char* stepsClosed = "first_steps/closed";

QSettings userSettings() { return QSettings(QSettings::IniFormat, QSettings::UserScope, "mrose", "mrose-gui"); }

void showShortcuts(const WindowFrame& frame) {
    auto* sheet = frame.window.findChild<ShortcutSheet*>();
    if (sheet == nullptr) sheet = new ShortcutSheet(frame.actions, &frame.window);
    sheet->show();
    sheet->raise();
    sheet->activateWindow();
}

void showAbout(const WindowFrame& frame) {
    auto* box = new QMessageBox(&frame.window);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setObjectName("about");
    box->setModal(false);
    box->setWindowTitle(QObject::tr("About mrose"));
    box->setTextFormat(Qt::RichText);
    box->setText(
        QObject::tr("<b>mrose %1</b><br>Mobile robots whose motion is learned from their logs").arg(MROSE_VERSION));
    box->setInformativeText(
        QObject::tr(
            "Its own source is under the BSD 3-Clause licence. This program contains QCustomPlot, and so it is as a "
            "whole under the GNU General Public License, version 3.<br><br>%1 build, %2, Qt %3")
            .arg(MROSE_BUILD_TYPE, MROSE_COMPILER, qVersion()));
    box->show();
}

Expected<void> showDocumentation() {
    const std::filesystem::path readme = resourceFolder() / "README.md";
    if (!QDesktopServices::openUrl(QUrl::fromLocalFile(qtText(readme.string()))))
        return fail(readme.string(), "no program is set up to show it");
    return {};
}

}  // namespace

void addHelpActions(const WindowFrame& frame, FieldView& field, PlotPanel& plots, CommandPanel& command,
                    Overlay& overlay) {
    Actions& actions = frame.actions;
    const QString menu = QObject::tr("&Help");
    QAction* steps = actions.add(menu,
                                 {"first_steps", QObject::tr("&First steps"), QKeySequence("Shift+F1"),
                                  QObject::tr("What to try first, ticked off as it is done"), true},
                                 [](bool) {});
    actions.add(menu,
                {"shortcuts", QObject::tr("&Shortcuts"), QKeySequence(Qt::Key_F1),
                 QObject::tr("All keys, and what the mouse does")},
                [&](bool) { showShortcuts(frame); });
    actions.addSeparator(menu);
    actions.add(
        menu,
        {"documentation", QObject::tr("&Documentation"), QKeySequence("Ctrl+F1"), QObject::tr("The README of mrose")},
        [&](bool) {
            if (actions.unattended()) return;
            if (const auto shown = showDocumentation(); !shown) frame.say(qtText(shown.error().message()));
        });
    actions.add(menu, {"about", QObject::tr("&About mrose"), {}, QObject::tr("Version and licence")},
                [&](bool) { showAbout(frame); });
    auto* card = new FirstSteps(frame, field, plots, command);
    QObject::connect(steps, &QAction::toggled, card, &QWidget::setVisible);
    // A log has panels of its own, and leaves the field no room for a card.
    QObject::connect(&overlay, &Overlay::changed, card, [&overlay, steps, had = false]() mutable {
        const bool has = overlay.rollouts().log() != nullptr;
        if (has && !std::exchange(had, has)) steps->setChecked(false);
        had = has;
    });
    QObject::connect(card, &FirstSteps::closeRequested, steps, [steps] {
        steps->setChecked(false);
        userSettings().setValue(stepsClosed, true);
    });
}

void showFirstSteps(Actions& actions) {
    if (!userSettings().value(stepsClosed, false).toBool()) actions["first_steps"].setChecked(true);
}

}  // namespace mrose::gui
