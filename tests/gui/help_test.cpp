// Menus, keys and what tells of them.
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QPainter>
#include <QScrollArea>
#include <QScrollBar>
#include <QStatusBar>
#include <QStatusTipEvent>
#include <QToolButton>
#include <map>
#include <set>

#include "actions/first_steps.h"
#include "actions/window_actions.h"
#include "frame/status_line.h"
#include "gui/window_fixture.h"
#include "panels/plot_panel.h"
#include "panels/shortcut_sheet.h"

namespace mrose::gui {
namespace {

using HelpTest = WindowTest;

/// All that menus hold, whoever put it there.
std::vector<QAction*> menuActions(const QMenu& menu) {
    std::vector<QAction*> found;
    for (QAction* action : menu.actions()) {
        if (action->menu() != nullptr || action->isSeparator()) continue;
        found.push_back(action);
    }
    return found;
}

TEST_F(HelpTest, EveryMenuEntryIsAnActionWithNameTipAndKey) {
    // About is found without a key.
    const std::set<QString> withoutKey{"about"}, inTwoMenus{"open_log"};
    std::set<QString> names;
    for (QAction* top : window.menuBar()->actions()) {
        ASSERT_NE(top->menu(), nullptr);
        EXPECT_TRUE(top->text().contains('&')) << top->text().toStdString();
        for (QAction* action : menuActions(*top->menu())) {
            const std::string text = action->text().toStdString();
            EXPECT_EQ(window.actions().find(action->objectName()), action) << text;
            const bool fresh = names.insert(action->objectName()).second;
            EXPECT_TRUE(fresh || inTwoMenus.count(action->objectName())) << text;
            EXPECT_FALSE(action->statusTip().isEmpty()) << text;
            EXPECT_TRUE(action->toolTip().startsWith(action->statusTip())) << text;
            EXPECT_EQ(action->shortcut().isEmpty(), withoutKey.count(action->objectName()) > 0) << text;
        }
    }
    EXPECT_GT(names.size(), 30u);
}

TEST_F(HelpTest, NoTwoActionsHaveTheSameKey) {
    std::map<QString, QString> users;
    for (const QAction* action : window.findChildren<QAction*>())
        for (const QKeySequence& key : action->shortcuts()) {
            const auto [user, fresh] = users.emplace(key.toString(), action->objectName());
            EXPECT_TRUE(fresh || user->second == action->objectName())
                << key.toString().toStdString() << ": " << user->second.toStdString() << " and "
                << action->objectName().toStdString();
        }
}

/// Letters after & within a menu; Qt takes the first and then the next, which is no quick way.
TEST_F(HelpTest, LettersOfAMenuDiffer) {
    for (QAction* top : window.menuBar()->actions()) {
        std::set<QChar> letters;
        for (QAction* action : menuActions(*top->menu())) {
            const int at = action->text().indexOf('&');
            if (at >= 0) {
                EXPECT_TRUE(letters.insert(action->text()[at + 1].toLower()).second)
                    << top->text().toStdString() << ": " << action->text().toStdString();
            }
        }
    }
}

TEST_F(HelpTest, SheetShowsEveryShortcutAndFindsThem) {
    key(Qt::Key_F1);
    auto* sheet = window.findChild<ShortcutSheet*>();
    ASSERT_NE(sheet, nullptr);
    EXPECT_TRUE(sheet->isVisible());
    EXPECT_FALSE(sheet->isModal());
    const auto shown = [&] {
        std::multiset<QString> texts;
        for (const QLabel* label : sheet->findChildren<QLabel*>()) texts.insert(label->text());
        return texts;
    };
    const std::multiset<QString> all = shown();
    for (const Actions::Group& group : window.actions().groups())
        for (const QAction* action : group.actions)
            if (!action->shortcut().isEmpty()) {
                EXPECT_TRUE(all.count(action->shortcut().toString(QKeySequence::NativeText)))
                    << action->objectName().toStdString();
            }
    QTest::keyClicks(sheet->findChild<QLineEdit*>(), "tick back");
    settle();
    EXPECT_EQ(shown(), (std::multiset<QString>{"Time", "One tick back", "Left"}));
    QTest::keyClick(sheet, Qt::Key_Escape);
    EXPECT_FALSE(sheet->isVisible());
}

TEST_F(HelpTest, SheetShowsAllKeysAtOnceOnASmallScreen) {
    window.resize(1280, 800);
    key(Qt::Key_F1);
    auto* sheet = window.findChild<ShortcutSheet*>();
    ASSERT_NE(sheet, nullptr);
    settle();
    EXPECT_LE(sheet->width(), 1270);
    EXPECT_LE(sheet->height(), 765) << "with a title bar";
    const auto* area = sheet->findChild<QScrollArea*>();
    EXPECT_LE(area->widget()->minimumSizeHint().height(), area->viewport()->height());
    EXPECT_FALSE(area->verticalScrollBar()->isVisible());
}

/// Dialogues are closed and others opened, and then all of them are told of the colours.
TEST_F(HelpTest, ColoursChangeAfterAnyDialogueWasClosed) {
    for (const char* name : {"shortcuts", "about", "export_film", "export_sequence"}) {
        window.actions()[name].trigger();
        settle();
        QDialog* dialogue = nullptr;
        for (QDialog* some : window.findChildren<QDialog*>())
            if (some->isVisible()) dialogue = some;
        ASSERT_NE(dialogue, nullptr) << name;
        for (const bool closed : {false, true}) {
            if (closed) QTest::keyClick(dialogue, Qt::Key_Escape);
            for (int i = 0; i < 2; ++i) {
                window.actions()["dark"].trigger();
                settle();
                EXPECT_EQ(window.palette().color(QPalette::Window), (i == 0 ? Theme::darkOne() : Theme::light()).panel);
            }
        }
    }
    // Its own colours go along.
    auto* sheet = window.findChild<ShortcutSheet*>();
    window.actions()["dark"].trigger();
    window.actions()["shortcuts"].trigger();
    settle();
    for (const QLabel* label : sheet->findChildren<QLabel*>())
        EXPECT_EQ(label->palette().color(QPalette::WindowText), Theme::darkOne().text);
    window.actions()["dark"].trigger();
}

/// What does not fit is a turn of the wheel away, and a bar says so.
TEST_F(HelpTest, SheetFitsTheScreenAndTellsOfWhatIsBelow) {
    window.resize(1280, 800);
    key(Qt::Key_F1);
    auto* sheet = window.findChild<ShortcutSheet*>();
    ASSERT_NE(sheet, nullptr);
    settle();
    EXPECT_LE(sheet->width(), 1280);
    EXPECT_LE(sheet->height(), 800);
    const auto* area = sheet->findChild<QScrollArea*>();
    EXPECT_LE(area->widget()->minimumSizeHint().width(), area->viewport()->width());
    EXPECT_EQ(area->verticalScrollBar()->isVisible(), area->widget()->height() > area->viewport()->height());
}

/// What an action does is told while it is pointed at, and not in place of what was said.
TEST_F(HelpTest, PointingAtAnActionLeavesTheMessageThere) {
    const auto message = [&] {
        QStringList shown;
        for (const QLabel* label : window.statusBar()->findChildren<QLabel*>())
            if (label->isVisible()) shown << label->text();
        return shown.join('|');
    };
    window.frame().say("red 1 kicked");
    const QString before = message();
    ASSERT_TRUE(before.contains("red 1 kicked") && before.contains("tick 0")) << before.toStdString();
    QStatusTipEvent points("Play or pause"), leaves("");
    QApplication::sendEvent(&window, &points);
    EXPECT_TRUE(message().contains("Play or pause") && message().contains("tick 0")) << message().toStdString();
    QApplication::sendEvent(&window, &leaves);
    EXPECT_EQ(message(), before);
}

TEST_F(HelpTest, FirstStepsNeitherShrinkTheFieldNorHideIt) {
    auto* card = window.findChild<FirstSteps*>();
    auto* button = window.findChild<QToolButton*>("first_steps_button");
    ASSERT_NE(button, nullptr);
    FieldView& field = window.field();
    int cards = 0, buttons = 0;
    for (const QSize size : {QSize(1280, 1150), QSize(1600, 760), QSize(1024, 640)}) {
        window.resize(size);
        settle();
        key(Qt::Key_F);
        const ViewTransform without = field.transform();
        key(Qt::Key_F1, Qt::ShiftModifier);
        key(Qt::Key_F);
        EXPECT_EQ(field.transform().scale(), without.scale()) << size.width();
        EXPECT_NE(card->isVisible(), button->isVisible()) << size.width();
        EXPECT_FALSE(card->isVisible() && field.viewport().fittedPlace().intersects(card->geometry())) << size.width();
        EXPECT_TRUE(field.rect().contains(card->isVisible() ? card->geometry() : button->geometry()));
        ++(card->isVisible() ? cards : buttons);
        if (button->isVisible()) {
            QTest::mouseClick(button, Qt::LeftButton);
            EXPECT_TRUE(card->isVisible()) << "over the field, as it was asked for";
            EXPECT_EQ(field.transform().scale(), without.scale());
        }
        key(Qt::Key_F1, Qt::ShiftModifier);
        EXPECT_FALSE(card->isVisible() || button->isVisible());
        EXPECT_TRUE(field.transform() == without);
    }
    EXPECT_GT(cards, 0);
    EXPECT_GT(buttons, 0);
}

TEST_F(HelpTest, LegendStandsClearOfTheFirstSteps) {
    window.field().setLayers(FieldLayers::none());
    key(Qt::Key_F1, Qt::ShiftModifier);
    auto* steps = window.findChild<FirstSteps*>();
    const QRect card =
        steps->folded() ? window.findChild<QToolButton*>("first_steps_button")->geometry() : steps->geometry();
    const auto legendOnCard = [&] {
        QImage with(window.field().size(), QImage::Format_RGB32), without = with;
        QPainter(&without).fillRect(without.rect(), Qt::black);
        const auto draw = [&](QImage& image, bool legend) {
            FieldLayers layers = window.field().layers();
            layers.set(FieldLayer::legend, legend);
            layers.set(FieldLayer::headings, true);
            window.field().setLayers(layers);
            window.field().render(&image, {}, {}, QWidget::DrawWindowBackground);
        };
        draw(with, true);
        draw(without, false);
        int changed = 0;
        for (int y = 0; y < with.height(); ++y)
            for (int x = 0; x < with.width(); ++x)
                if (with.pixel(x, y) != without.pixel(x, y)) changed += card.contains(x, y) ? 1 : 0;
        return changed;
    };
    EXPECT_EQ(legendOnCard(), 0);
    key(Qt::Key_F1, Qt::ShiftModifier);
    EXPECT_GT(legendOnCard(), 100) << "the corner is the legend's own otherwise";
}

TEST_F(HelpTest, KeysAsTextHaveALineForEachAction) {
    const QString text = shortcutText(shortcutGroups(window.actions()));
    EXPECT_TRUE(text.startsWith("File\n")) << text.toStdString();
    for (const Actions::Group& group : window.actions().groups())
        for (const QAction* action : group.actions)
            EXPECT_TRUE(text.contains("  " + action->shortcut().toString(QKeySequence::NativeText)) &&
                        text.contains(action->statusTip() + '\n'))
                << action->objectName().toStdString();
}

std::size_t doneSteps(const FirstSteps& card) {
    return static_cast<std::size_t>(std::count_if(card.steps().begin(), card.steps().end(),
                                                  [](const FirstSteps::Step& step) { return step.done; }));
}

TEST_F(HelpTest, FirstStepsAreTickedOffAsTheyAreDone) {
    auto* card = window.findChild<FirstSteps*>();
    ASSERT_NE(card, nullptr);
    EXPECT_FALSE(card->isVisible());
    window.resize(1280, 1150);
    settle();
    key(Qt::Key_F1, Qt::ShiftModifier);
    EXPECT_TRUE(card->isVisible());
    EXPECT_TRUE(window.field().rect().contains(card->geometry()));
    EXPECT_EQ(doneSteps(*card), 0u);
    key(Qt::Key_Space);
    key(Qt::Key_Space);
    EXPECT_EQ(doneSteps(*card), 1u);
    key(Qt::Key_Left);
    EXPECT_EQ(doneSteps(*card), 2u);
    window.session().seek(300);
    settle();
    EXPECT_EQ(doneSteps(*card), 2u);
    drag(pixelOf(2), pixelOf(2) + QPointF(40, -30));
    EXPECT_EQ(doneSteps(*card), 3u);
    key(Qt::Key_K);
    key(Qt::Key_S);
    EXPECT_EQ(doneSteps(*card), 5u);
    key(Qt::Key_S);
    key(Qt::Key_E);
    key(Qt::Key_Return, Qt::ControlModifier);
    EXPECT_EQ(doneSteps(*card), 6u);
    ASSERT_TRUE(window.plots().addExpression("ball.speed"));
    EXPECT_EQ(doneSteps(*card), 7u);
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(doneSteps(*card), 8u);
    key(Qt::Key_F1);
    EXPECT_EQ(doneSteps(*card), 9u);
    window.actions().setUnattended(true);  // no dialogue
    window.actions()["open_log"].trigger();
    EXPECT_EQ(doneSteps(*card), card->steps().size());
}

TEST_F(HelpTest, WhatCameToNothingIsNotTickedOff) {
    auto* card = window.findChild<FirstSteps*>();
    const auto said = [&] {
        QStringList shown;
        for (const QLabel* label : window.statusBar()->findChildren<QLabel*>()) shown << label->text();
        return shown.join('|').toStdString();
    };
    key(Qt::Key_Space);
    key(Qt::Key_Space);
    window.session().seek(0);
    settle();
    const std::size_t before = doneSteps(*card);
    key(Qt::Key_K);  // no robot has kicked yet
    key(Qt::Key_S);  // there is no other branch
    EXPECT_NE(said().find("no other branch"), std::string::npos) << said();
    key(Qt::Key_E);  // no robot is selected
    EXPECT_NE(said().find("Select a robot first"), std::string::npos) << said();
    key(Qt::Key_Return, Qt::ControlModifier);
    key(Qt::Key_Z, Qt::ControlModifier);  // nothing was changed
    EXPECT_EQ(doneSteps(*card), before);
}

TEST_F(HelpTest, WhatIsAskedForIsNotSaidAnyLongerOnceItIsDone) {
    key(Qt::Key_E);
    ASSERT_TRUE(window.frame().status.said().startsWith("Select a robot first"))
        << window.frame().status.said().toStdString();
    window.field().setSelected(2);
    EXPECT_EQ(window.frame().status.said(), "");
    EXPECT_FALSE(window.frame().status.quietMessage().isVisible());
    // What is said otherwise stays for a while.
    window.frame().say("something");
    window.field().setSelected(1);
    EXPECT_EQ(window.frame().status.said(), "something");
    EXPECT_TRUE(QTest::qWaitFor([&] { return window.frame().status.said().isEmpty(); }, 10'000));
}

TEST_F(HelpTest, ClosedFirstStepsStayAwayUntilTheyAreAskedFor) {
    auto* card = window.findChild<FirstSteps*>();
    window.resize(1280, 1150);
    settle();
    showFirstSteps(window.actions());
    ASSERT_TRUE(card->isVisible());
    QTest::mouseClick(card->findChild<QToolButton*>(), Qt::LeftButton);
    EXPECT_FALSE(card->isVisible());
    MainWindow next;
    showFirstSteps(next.actions());
    EXPECT_FALSE(next.actions()["first_steps"].isChecked());
    next.actions()["first_steps"].trigger();
    EXPECT_TRUE(next.actions()["first_steps"].isChecked());
}

}  // namespace
}  // namespace mrose::gui
