// What keys do while something is typed in a panel.
#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QSpinBox>
#include <QToolBar>
#include <QToolButton>
#include <set>

#include "frame/focus_ring.h"
#include "frame/status_line.h"
#include "gui/window_fixture.h"
#include "panels/breakpoint_panel.h"
#include "panels/command_panel.h"
#include "panels/plot_panel.h"

namespace mrose::gui {
namespace {

class InputKeysTest : public WindowTest {
protected:
    void SetUp() override {
        WindowTest::SetUp();
        window.activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
        window.session().seek(100);
        window.field().setSelected(1);
        settle();
    }
    /// To whatever has the focus, by way of the window's shortcuts.
    void press(Qt::Key key) {
        QTest::keyClick(window.windowHandle(), key);
        settle();
    }
};

TEST_F(InputKeysTest, EscapeTakesANumberBackAndGivesKeysToTheField) {
    const auto boxes = window.commandPanel().findChildren<QDoubleSpinBox*>();
    ASSERT_GE(boxes.size(), 2);
    press(Qt::Key_E);
    ASSERT_TRUE(boxes[0]->hasFocus());
    const double forward = boxes[0]->value(), turning = boxes[1]->value();
    press(Qt::Key_1);
    press(Qt::Key_Tab);
    press(Qt::Key_2);
    EXPECT_NE(boxes[0]->value(), forward);
    EXPECT_NE(boxes[1]->value(), turning);
    press(Qt::Key_Escape);
    EXPECT_EQ(boxes[0]->value(), forward);
    EXPECT_EQ(boxes[1]->value(), turning);
    EXPECT_TRUE(window.field().hasFocus());
    press(Qt::Key_G);
    EXPECT_TRUE(window.actions()["layer_grid"].isChecked()) << "keys are the window's again";
    press(Qt::Key_G);
}

TEST_F(InputKeysTest, LettersInAListChooseFromIt) {
    auto* kick = window.commandPanel().findChild<QComboBox*>();
    ASSERT_TRUE(kick != nullptr && kick->count() >= 2);
    press(Qt::Key_E);
    kick->setFocus();
    kick->setCurrentIndex(1);
    const bool names = window.actions()["layer_names"].isChecked();
    const std::int64_t tick = window.shown()->tick();
    press(Qt::Key_N);
    EXPECT_EQ(kick->currentText(), "none");
    EXPECT_EQ(window.actions()["layer_names"].isChecked(), names);
    kick->setCurrentIndex(1);
    press(Qt::Key_Home);
    EXPECT_EQ(kick->currentIndex(), 0);
    EXPECT_EQ(window.shown()->tick(), tick);
}

TEST_F(InputKeysTest, SpaceInANumberPlaysAndLeavesIt) {
    auto* forward = window.commandPanel().findChild<QDoubleSpinBox*>();
    press(Qt::Key_E);
    const QString before = forward->text();
    int plays = 0;
    QObject::connect(&window.actions()["play"], &QAction::triggered, &window, [&] { ++plays; });
    press(Qt::Key_Space);
    EXPECT_EQ(plays, 1);
    press(Qt::Key_Space);
    EXPECT_EQ(plays, 2);
    window.session().seek(100);
    settle();
    EXPECT_EQ(forward->text(), before);
}

TEST_F(InputKeysTest, EscapeLeavesEveryInputOfAPanel) {
    window.frame().showDock("plots");
    window.frame().showDock("reality");
    settle();
    int inputs = 0;
    for (const char* name : {"branches", "breakpoints", "command", "reality", "plots"}) {
        QWidget* dock = window.findChild<QWidget*>(name);
        dock->raise();
        for (QWidget* input : dock->findChildren<QWidget*>()) {
            const bool number = qobject_cast<QAbstractSpinBox*>(input) != nullptr;
            auto* line = qobject_cast<QLineEdit*>(input);
            const bool own = line != nullptr && qobject_cast<QAbstractSpinBox*>(input->parentWidget()) == nullptr;
            if ((!number && !own) || !input->isVisible() || !input->isEnabled()) continue;
            input->setFocus();
            ASSERT_TRUE(input->hasFocus()) << name;
            auto* text = number ? input->findChild<QLineEdit*>() : line;
            const QString before = text->text();
            text->selectAll();
            press(Qt::Key_7);
            EXPECT_NE(text->text(), before) << name;
            press(Qt::Key_Escape);
            EXPECT_EQ(text->text(), before) << name;
            EXPECT_TRUE(window.field().hasFocus()) << name;
            ++inputs;
        }
    }
    EXPECT_GE(inputs, 5);
}

TEST_F(InputKeysTest, ReturnInTheListOfKicksTriesTheCommand) {
    auto* kick = window.commandPanel().findChild<QComboBox*>();
    press(Qt::Key_E);
    kick->setFocus();
    kick->setCurrentIndex(1);
    press(Qt::Key_Return);
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    EXPECT_NE(window.shown()->branches[1].name.find("kick 100 %"), std::string::npos)
        << window.shown()->branches[1].name;
}

TEST_F(InputKeysTest, WhatNeedsAPausePausesAndSaysSo) {
    const auto boxes = window.commandPanel().findChildren<QDoubleSpinBox*>();
    const auto begin = [&](std::optional<std::size_t> robot) {
        window.field().setSelected(robot);
        window.field().setFocus();
        window.session().play();
        settle();
        ASSERT_TRUE(window.shown()->playing);
    };
    begin(1);
    press(Qt::Key_E);
    EXPECT_FALSE(window.shown()->playing);
    EXPECT_TRUE(boxes[0]->hasFocus());
    EXPECT_TRUE(window.frame().status.said().startsWith("Stopped, since commands"))
        << window.frame().status.said().toStdString();
    begin(1);
    QTest::keyClick(window.windowHandle(), Qt::Key_Left, Qt::AltModifier);
    settle();
    QTest::keyRelease(window.windowHandle(), Qt::Key_Alt);
    settle();
    EXPECT_FALSE(window.shown()->playing);
    EXPECT_EQ(window.shown()->branches.size(), 2u) << "and does it";
    begin({});
    press(Qt::Key_E);
    EXPECT_TRUE(window.frame().status.said().startsWith("Select a robot first"))
        << window.frame().status.said().toStdString();
}

TEST_F(InputKeysTest, ShortMessagesAreSeenWhileTheRunPlays) {
    window.session().play();
    settle();
    window.frame().say("seen");
    const std::int64_t tick = window.shown()->tick();
    while (window.shown()->tick() < tick + 5) QTest::qWait(20);
    EXPECT_EQ(window.frame().status.said(), "seen");
    EXPECT_TRUE(window.frame().status.quietMessage().isVisible());
}

TEST_F(InputKeysTest, TabReachesAllToolsAndTheTimelineAndTheyAreUsedThere) {
    auto* bar = window.findChild<QToolBar*>("time_bar");
    std::set<QWidget*> wanted{&window.timeline(), &window.field()};
    for (QAction* action : bar->actions()) {
        QWidget* tool = bar->widgetForAction(action);
        if (tool->isEnabled() && (qobject_cast<QToolButton*>(tool) || qobject_cast<QComboBox*>(tool)))
            wanted.insert(tool);
    }
    ASSERT_GT(wanted.size(), 10u);
    auto* ring = window.findChild<FocusRing*>();
    std::set<QWidget*> reached;
    window.field().setFocus();
    const auto focused = [] { return QApplication::focusWidget(); };
    for (int i = 0; i < 60 && reached.size() < wanted.size(); ++i) {
        if (wanted.count(focused()) != 0) {
            reached.insert(focused());
            EXPECT_EQ(ring->shownAbout(), focused()) << "it is seen where the keys go";
        }
        QTest::keyClick(focused(), Qt::Key_Tab);
    }
    EXPECT_EQ(reached, wanted);

    QWidget* step = bar->widgetForAction(&window.actions()["tick_forward"]);
    const std::int64_t tick = window.shown()->tick();
    for (const Qt::Key key : {Qt::Key_Space, Qt::Key_Return}) {
        step->setFocus(Qt::TabFocusReason);
        press(key);
        EXPECT_EQ(step, focused());
    }
    EXPECT_EQ(window.shown()->tick(), tick + 2);
    EXPECT_FALSE(window.shown()->playing);
    auto* speed = bar->findChild<QComboBox*>();
    const int chosen = speed->currentIndex();
    speed->setFocus(Qt::TabFocusReason);
    press(Qt::Key_Down);
    EXPECT_EQ(speed->currentIndex(), chosen + 1);
    press(Qt::Key_Up);
    window.timeline().setFocus(Qt::TabFocusReason);
    press(Qt::Key_PageDown);
    EXPECT_GT(window.shown()->tick(), tick + 100);
    EXPECT_TRUE(window.timeline().hasFocus());
    QTest::mouseClick(step, Qt::LeftButton);
    EXPECT_TRUE(window.timeline().hasFocus()) << "a click takes no keys";
}

}  // namespace
}  // namespace mrose::gui
