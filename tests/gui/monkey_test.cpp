// Thousands of events without any sense: the window stays alive, and the run is that of the program without a window.
#include <QAbstractScrollArea>
#include <QAction>
#include <QApplication>
#include <QMenu>
#include <QWheelEvent>
#include <algorithm>
#include <random>

#include "files/window_files.h"
#include "gui/window_fixture.h"
#include "panels/plot_panel.h"
#include "reality/overlay.h"
#include "simulation/step.h"
#include "support/places.h"
#include "world/state_hash.h"

namespace mrose::gui {
namespace {

constexpr int eventsOfOne = 1250;

/// A user who presses, clicks, drags, turns the wheel and resizes at random. Dialogues are dismissed as they come.
class Monkey {
public:
    Monkey(MainWindow& window, unsigned seed) : window_(window), random_(seed) {
        for (const Actions::Group& group : window.actions().groups())
            for (QAction* action : group.actions)
                // These leave the window, or the program.
                if (const QString name = action->objectName(); name != "quit" && name != "documentation")
                    actions_.push_back(action);
        QObject::connect(&dismissing_, &QTimer::timeout, &window, [] {
            if (auto* dialogue = qobject_cast<QDialog*>(QApplication::activeModalWidget())) dialogue->reject();
            if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
        });
        dismissing_.start(1);
    }

    void play(int events) {
        for (int i = 0; i < events; ++i) {
            one();
            if (i % 8 == 7) QApplication::processEvents();
        }
    }

private:
    int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(std::max(1, end))); }

    void one() {
        switch (below(12)) {
            case 0:
            case 1:
            case 2:
                return trigger();
            case 3:
                return key();
            case 4:
                return wheel();
            case 5:
            case 6:
                return drag();
            case 7:
                if (below(20) == 0) window_.resize(640 + below(1300), 480 + below(700));
                return;
            default:
                return click();
        }
    }
    void trigger() {
        QAction* const action = actions_[static_cast<std::size_t>(below(static_cast<int>(actions_.size())))];
        if (action->isEnabled()) action->trigger();
    }
    void key() {
        static constexpr Qt::Key keys[] = {Qt::Key_Tab, Qt::Key_Return, Qt::Key_Escape, Qt::Key_Delete, Qt::Key_Down,
                                           Qt::Key_Up,  Qt::Key_Left,   Qt::Key_Right,  Qt::Key_1,      Qt::Key_Space,
                                           Qt::Key_F2,  Qt::Key_Home,   Qt::Key_End,    Qt::Key_A,      Qt::Key_PageUp};
        static constexpr Qt::KeyboardModifier modifiers[] = {Qt::NoModifier, Qt::NoModifier, Qt::ShiftModifier,
                                                             Qt::ControlModifier, Qt::AltModifier};
        QWidget* const focused = window_.focusWidget() != nullptr ? window_.focusWidget() : &window_;
        QTest::keyClick(focused, keys[below(std::size(keys))], modifiers[below(std::size(modifiers))]);
    }
    /// One that is seen, and a place in it.
    std::pair<QWidget*, QPoint> somewhere() {
        std::vector<QWidget*> seen;
        for (QWidget* widget : window_.findChildren<QWidget*>())
            if (widget->isVisible() && !widget->isWindow() && !widget->visibleRegion().isEmpty() &&
                widget->window() == &window_)
                seen.push_back(widget);
        // Where most of the work is done.
        QWidget* const widget = seen.empty() || below(3) == 0
                                    ? &window_.field()
                                    : seen[static_cast<std::size_t>(below(static_cast<int>(seen.size())))];
        return {widget, {below(widget->width()), below(widget->height())}};
    }
    void click() {
        const auto [widget, at] = somewhere();
        const Qt::MouseButton button = below(6) == 0 ? Qt::RightButton : Qt::LeftButton;
        if (below(8) == 0)
            QTest::mouseDClick(widget, button, Qt::NoModifier, at);
        else
            QTest::mouseClick(widget, button, below(8) == 0 ? Qt::ControlModifier : Qt::NoModifier, at);
    }
    void drag() {
        const auto [widget, from] = somewhere();
        const QPointer<QWidget> held = widget;
        QTest::mousePress(widget, Qt::LeftButton, Qt::NoModifier, from);
        for (int i = 0; i < 3 && held; ++i) QTest::mouseMove(held, {below(held->width()), below(held->height())});
        if (held)
            QTest::mouseRelease(held, Qt::LeftButton, Qt::NoModifier, {below(held->width()), below(held->height())});
    }
    void wheel() {
        const auto [widget, at] = somewhere();
        QWheelEvent event(at, widget->mapToGlobal(at), {}, {0, below(2) == 0 ? 120 : -120}, Qt::NoButton,
                          below(4) == 0 ? Qt::ControlModifier : Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(widget, &event);
    }

    MainWindow& window_;
    std::mt19937 random_;
    std::vector<QAction*> actions_;
    QTimer dismissing_;
};

class MonkeyTest : public WindowTest, public testing::WithParamInterface<unsigned> {
protected:
    /// The run itself, whatever its branches are.
    void expectRunIsUntouched(const Scenario& scenario) {
        window.session().pause();
        gui::settle(window.scripted());
        constexpr std::int64_t tick = 60;
        window.session().show(0, 0);
        window.session().seek(tick);
        settle();
        ASSERT_EQ(window.shown()->branch, 0u);
        ASSERT_EQ(window.shown()->tick(), tick);
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        while (state.tick < tick) step(scenario, state, buffers);
        EXPECT_EQ(window.shown()->hash, hashOf(state));
    }
};

TEST_P(MonkeyTest, TheGameSurvives) {
    window.files().saver().setQuestion([](const QString&) { return RunSaver::Answer::discard; });
    const std::shared_ptr<const Scenario> scenario = window.shown()->frame->scenario;
    const std::uint64_t run = window.shown()->run;
    Monkey(window, GetParam()).play(eventsOfOne);
    ASSERT_EQ(window.shown()->run, run);
    ASSERT_NO_FATAL_FAILURE(expectRunIsUntouched(*scenario));
}

TEST_P(MonkeyTest, ALogLaidOverSurvives) {
    window.files().saver().setQuestion([](const QString&) { return RunSaver::Answer::discard; });
    const std::string log = (sourceFolder() / "resources" / "logs" / "pioneer" / "random.csv").string();
    ASSERT_TRUE(window.overlay().openNow({log, ""}));
    gui::settle(window.scripted());
    Monkey(window, GetParam() + 100).play(eventsOfOne);
    window.session().pause();
    gui::settle(window.scripted());
    ASSERT_NE(window.shown(), nullptr);
    for (const RobotState& robot : window.shown()->frame->state.robots)
        EXPECT_TRUE(std::isfinite(robot.pose.x + robot.pose.y + robot.pose.heading));
}

INSTANTIATE_TEST_SUITE_P(Seeds, MonkeyTest, testing::Values(1U, 2U, 3U, 4U));

}  // namespace
}  // namespace mrose::gui
