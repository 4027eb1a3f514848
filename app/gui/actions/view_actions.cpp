#include <array>
#include <memory>
#include <numbers>

#include "actions/window_actions.h"
#include "frame/actions.h"
#include "frame/window_memory.h"
#include "reality/field_bands.h"
#include "widgets/field_view.h"
#include "widgets/icons.h"

namespace mrose::gui {
namespace {

constexpr double panStep = 60;      // pixels
constexpr double nudgeStep = 0.01;  // m
constexpr double nudgeTurn = std::numbers::pi / 180;
constexpr std::array trailSeconds{2, 5, 10, 20, 40, 120, 600};
constexpr std::size_t usualTrail = 2;
constexpr std::array bandSeconds{1, 2, 5, 10, 20, 40};
constexpr std::size_t usualBand = 2;

void addPanActions(const WindowFrame& frame, FieldView& field, const QString& menu) {
    struct Way {
        const char *name, *text, *key, *tip;
        QPointF by;
    };
    for (const Way& way :
         {Way{"pan_left", "Move view left", "Ctrl+Shift+Left", "Show what lies left", {panStep, 0}},
          Way{"pan_right", "Move view right", "Ctrl+Shift+Right", "Show what lies right", {-panStep, 0}},
          Way{"pan_up", "Move view up", "Ctrl+Shift+Up", "Show what lies above", {0, panStep}},
          Way{"pan_down", "Move view down", "Ctrl+Shift+Down", "Show what lies below", {0, -panStep}}})
        frame.actions.add(menu, {way.name, QObject::tr(way.text), QKeySequence(way.key), QObject::tr(way.tip)},
                          [&field, by = way.by](bool) { field.viewport().pan(by); });
}

void addNudgeActions(const WindowFrame& frame, FieldView& field, const QString& menu) {
    struct Way {
        const char *name, *text, *key, *tip;
        Pose by;
    };
    const char* moves = "Move the selected body by 1 cm, while the run stands";
    const char* turns = "Turn the selected body by 1 degree, while the run stands";
    for (const Way& way : {Way{"nudge_left", "Nudge left", "Alt+Left", moves, {-nudgeStep, 0, 0}},
                           Way{"nudge_right", "Nudge right", "Alt+Right", moves, {nudgeStep, 0, 0}},
                           Way{"nudge_up", "Nudge up", "Alt+Up", moves, {0, nudgeStep, 0}},
                           Way{"nudge_down", "Nudge down", "Alt+Down", moves, {0, -nudgeStep, 0}},
                           Way{"turn_left", "Turn left", "Alt+Shift+Left", turns, {0, 0, nudgeTurn}},
                           Way{"turn_right", "Turn right", "Alt+Shift+Right", turns, {0, 0, -nudgeTurn}}})
        frame.actions.add(menu, {way.name, QObject::tr(way.text), QKeySequence(way.key), QObject::tr(way.tip)},
                          [&frame, &field, by = way.by](bool) {
                              if (!field.selected()) return frame.say(QObject::tr("Select a robot or an object first"));
                              frame.whenStanding(QObject::tr("Stopped, since bodies are moved while the run stands"),
                                                 [&field, by] { field.nudge(by); });
                          });
}

/// How far back trails reach, by steps of a list.
void addTrailActions(const WindowFrame& frame, const QString& menu) {
    const auto chosen = std::make_shared<std::size_t>(usualTrail);
    const auto change = [&frame, chosen](int by) {
        const std::size_t next = *chosen + static_cast<std::size_t>(by);
        if (!frame.shown() || next >= trailSeconds.size()) return;
        *chosen = next;
        FrameOptions options;
        options.trailTicks =
            static_cast<std::size_t>(frame.shown()->frame->scene().ticksOf(trailSeconds[next] * nanosecondsPerSecond));
        frame.session.setFrameOptions(options);
        frame.say(QObject::tr("Trails of the last %1 s").arg(trailSeconds[next]));
    };
    frame.actions.add(menu,
                      {"trails_longer", QObject::tr("Longer trails"), QKeySequence("Shift+T"),
                       QObject::tr("Trails reach further back, up to ten minutes")},
                      [change](bool) { change(1); });
    frame.actions.add(menu,
                      {"trails_shorter", QObject::tr("Shorter trails"), QKeySequence("Ctrl+T"),
                       QObject::tr("Trails reach less far back, down to two seconds")},
                      [change](bool) { change(-1); });
}

/// How far ahead it is shown where robots may be, by steps of a list.
void addBandActions(const WindowFrame& frame, FieldView& field, FieldBands& bands, const QString& menu) {
    const auto chosen = std::make_shared<std::size_t>(usualBand);
    const auto change = [&frame, &field, &bands, chosen](int by) {
        const std::size_t next = *chosen + static_cast<std::size_t>(by);
        if (next >= bandSeconds.size()) return;
        *chosen = next;
        bands.setAhead(bandSeconds[next] * nanosecondsPerSecond);
        if (!field.layers().has(FieldLayer::uncertainty)) frame.actions["layer_uncertainty"].trigger();
        frame.say(QObject::tr("Where robots may be in the next %1 s").arg(bandSeconds[next]));
    };
    frame.actions.add(menu,
                      {"uncertainty_longer", QObject::tr("Uncertainty further ahead"), QKeySequence("Shift+Q"),
                       QObject::tr("Where robots may be is shown further ahead, up to 40 s")},
                      [change](bool) { change(1); });
    frame.actions.add(menu,
                      {"uncertainty_shorter", QObject::tr("Uncertainty less far ahead"), QKeySequence("Alt+Q"),
                       QObject::tr("Where robots may be is shown less far ahead, down to 1 s")},
                      [change](bool) { change(-1); });
}

void selectNext(const WindowFrame& frame, FieldView& field, int by) {
    if (!frame.shown()) return;
    const auto count = static_cast<int>(frame.shown()->frame->scene().bodyCount());
    const int now = field.selected() ? static_cast<int>(*field.selected()) : (by > 0 ? -1 : 0);
    if (count > 0) field.setSelected(static_cast<std::size_t>((now + by + count) % count));
}

}  // namespace

void addViewActions(const WindowFrame& frame, FieldView& field, const std::function<void(const Theme&)>& setTheme) {
    Actions& actions = frame.actions;
    const QString menu = QObject::tr("&View");
    actions.add(menu, {"fit", QObject::tr("&Whole field"), QKeySequence("F"), QObject::tr("Show all of the field")},
                [&](bool) { field.viewport().fit(); });
    actions.add(menu, {"zoom_in", QObject::tr("Zoom &in"), QKeySequence("Ctrl++"), QObject::tr("Larger")},
                [&](bool) { field.viewport().zoom(1.25); });
    actions.add(menu, {"zoom_out", QObject::tr("Zoom &out"), QKeySequence("Ctrl+-"), QObject::tr("Smaller")},
                [&](bool) { field.viewport().zoom(0.8); });
    actions.add(menu,
                {"follow", QObject::tr("&Follow the selected"), QKeySequence("L"),
                 QObject::tr("The view goes along with the selected robot"), true},
                [&](bool on) { field.viewport().setFollowing(on); });
    QObject::connect(&field, &FieldView::followRequested, &field, [&actions] {
        if (!actions["follow"].isChecked()) actions["follow"].trigger();
    });
    actions.add(menu,
                {"turn", QObject::tr("&Turn the field"), QKeySequence("Shift+L"),
                 QObject::tr("By a quarter, as it is where it is much larger then; all of it again as suits: F")},
                [&](bool) { field.viewport().setTurned(!field.transform().turned()); });
    addPanActions(frame, field, menu);
    actions.addSeparator(menu);
    actions.add(menu,
                {"select_next", QObject::tr("Select &next"), QKeySequence("Ctrl+Right"),
                 QObject::tr("Select the next robot or object")},
                [&](bool) { selectNext(frame, field, 1); });
    actions.add(menu,
                {"select_previous", QObject::tr("Select &previous"), QKeySequence("Ctrl+Left"),
                 QObject::tr("Select the previous robot or object")},
                [&](bool) { selectNext(frame, field, -1); });
    actions.addSeparator(QObject::tr("&Edit"));
    addNudgeActions(frame, field, QObject::tr("&Edit"));
    actions.addSeparator(menu);
    actions.add(menu,
                {"reset_layout", QObject::tr("Reset la&yout"), QKeySequence("Ctrl+Shift+L"),
                 QObject::tr("Panels and tool bars as in a new window; its size, too, unless it fills the screen")},
                [&](bool) { frame.memory.resetLayout(); });
    actions.add(menu,
                {"dark", QObject::tr("Dar&k colours"), QKeySequence("Ctrl+D"),
                 QObject::tr("Dark colours, for dark rooms"), true},
                [setTheme](bool on) { setTheme(on ? Theme::darkOne() : Theme::light()); });
    actions.add(
        menu,
        {"full_screen", QObject::tr("Full &screen"), QKeySequence("F11"),
         QObject::tr("The window on all of the screen"), true},
        [&](bool on) { frame.window.setWindowState(frame.window.windowState().setFlag(Qt::WindowFullScreen, on)); });
}

void addLayerActions(const WindowFrame& frame, FieldView& field, FieldBands& bands) {
    for (const FieldLayerText& layer : fieldLayerTexts) {
        QAction* action = frame.actions.add(
            QObject::tr("&Layers"),
            {layer.action, QObject::tr(layer.name), QKeySequence(layer.key), QObject::tr(layer.tip), true, layer.shown},
            [](bool) {});
        QObject::connect(action, &QAction::toggled, &field, [&field, which = layer.layer](bool on) {
            FieldLayers layers = field.layers();
            layers.set(which, on);
            field.setLayers(layers);
        });
    }
    frame.actions.addSeparator(QObject::tr("&Layers"));
    addTrailActions(frame, QObject::tr("&Layers"));
    addBandActions(frame, field, bands, QObject::tr("&Layers"));
}

}  // namespace mrose::gui
