#include "main_window.h"
#include "widgets/field_view.h"
#include "window_actions.h"
#include "window_memory.h"

namespace mrose::gui {
namespace {

void selectNext(MainWindow& window, int by) {
    if (!window.shown()) return;
    FieldView& field = window.field();
    const auto count = static_cast<int>(window.shown()->frame->scene().bodyCount());
    const int now = field.selected() ? static_cast<int>(*field.selected()) : (by > 0 ? -1 : 0);
    if (count > 0) field.setSelected(static_cast<std::size_t>((now + by + count) % count));
}

}  // namespace

void addViewActions(MainWindow& window) {
    Actions& actions = window.actions();
    FieldView& field = window.field();
    const QString menu = QObject::tr("&View");
    actions.add(menu, {"fit", QObject::tr("&Whole field"), QKeySequence("F"), QObject::tr("Show all of the field")},
                [&](bool) { field.fit(); });
    actions.add(menu, {"zoom_in", QObject::tr("Zoom &in"), QKeySequence("Ctrl++"), QObject::tr("Larger")},
                [&](bool) { field.zoom(1.25); });
    actions.add(menu, {"zoom_out", QObject::tr("Zoom &out"), QKeySequence("Ctrl+-"), QObject::tr("Smaller")},
                [&](bool) { field.zoom(0.8); });
    actions.add(menu,
                {"follow", QObject::tr("&Follow the selected"), QKeySequence("L"),
                 QObject::tr("The view goes along with the selected robot"), true},
                [&](bool on) { field.setFollowing(on); });
    actions.addSeparator(menu);
    actions.add(menu,
                {"select_next", QObject::tr("Select &next"), QKeySequence("Ctrl+Right"),
                 QObject::tr("Select the next robot or object")},
                [&](bool) { selectNext(window, 1); });
    actions.add(menu,
                {"select_previous", QObject::tr("Select &previous"), QKeySequence("Ctrl+Left"),
                 QObject::tr("Select the previous robot or object")},
                [&](bool) { selectNext(window, -1); });
    actions.addSeparator(menu);
    actions.add(menu,
                {"reset_layout", QObject::tr("&Reset layout"), QKeySequence(),
                 QObject::tr("Panels, tool bars and size as in a new window")},
                [&](bool) { window.memory().resetLayout(); });
    actions.add(menu,
                {"dark", QObject::tr("&Dark colours"), QKeySequence("Ctrl+D"),
                 QObject::tr("Dark colours, for dark rooms"), true},
                [&](bool on) { window.setTheme(on ? Theme::darkOne() : Theme::light()); });
    actions.add(menu,
                {"full_screen", QObject::tr("F&ull screen"), QKeySequence("F11"),
                 QObject::tr("The window on all of the screen"), true},
                [&](bool on) { window.setWindowState(window.windowState().setFlag(Qt::WindowFullScreen, on)); });
}

void addLayerActions(MainWindow& window) {
    for (const FieldLayerText& layer : fieldLayerTexts) {
        QAction* action = window.actions().add(
            QObject::tr("&Layers"),
            {layer.action, QObject::tr(layer.name), QKeySequence(layer.key), QObject::tr(layer.tip), true, layer.shown},
            [](bool) {});
        QObject::connect(action, &QAction::toggled, &window, [&window, which = layer.layer](bool on) {
            FieldLayers layers = window.field().layers();
            layers.set(which, on);
            window.field().setLayers(layers);
        });
    }
}

}  // namespace mrose::gui
