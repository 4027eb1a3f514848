// What the window does where room is scarce, and when there is more of it again.
#include <QAction>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QStatusBar>
#include <QToolButton>

#include "actions/first_steps.h"
#include "frame/quiet_message.h"
#include "frame/status_line.h"
#include "gui/window_fixture.h"
#include "panels/breakpoint_panel.h"
#include "panels/plot_panel.h"
#include "panels/side_view.h"
#include "widgets/message_bar.h"

namespace mrose::gui {
namespace {

class RoomTest : public WindowTest {
protected:
    void SetUp() override {
        WindowTest::SetUp();
        window.resize(1280, 800);
        window.session().seek(120);
        settle();
    }
    void move(std::size_t body) {
        drag(pixelOf(body), pixelOf(body) + QPointF(30, 12));
        ASSERT_EQ(window.shown()->branches.size(), 2u);
    }
    QDockWidget& dock(const char* name) { return *window.findChild<QDockWidget*>(name); }
    /// Layouts, scrolling and what follows them.
    void settleLayout() {
        settle();
        QTest::qWait(0);
        settle();
    }
};

bool seenWhole(const QWidget& widget) {
    return widget.isVisible() && widget.visibleRegion().boundingRect() == widget.rect();
}

TEST_F(RoomTest, NamesOfAnyLengthLeaveTheWindowItsWidth) {
    move(2);
    for (const QString& name : {QString("word ").repeated(40), QString(200, 'w')}) {
        window.session().ask([branch = window.shown()->branch, name = name.toStdString()](Debugger& debugger) {
            debugger.run().branches().rename(branch, name);
        });
        settle();
        key(Qt::Key_S);
        window.frame().say(name);
        window.messages().add({MessageBar::Kind::note, name, "topic", {{name, "what it does", [] {}}}});
        settleLayout();
        EXPECT_LE(window.minimumSizeHint().width(), 1280);
        EXPECT_EQ(window.width(), 1280);
        key(Qt::Key_X);
        settleLayout();
        EXPECT_EQ(window.width(), 1280) << "the long name is the other one";
        for (const QToolButton* button : window.messages().findChildren<QToolButton*>("dismiss"))
            EXPECT_TRUE(window.messages().rect().contains(button->geometry().translated(button->parentWidget()->pos())))
                << "the button has not pushed it out";
        key(Qt::Key_X);
        key(Qt::Key_S);
    }
}

TEST_F(RoomTest, BreakpointLineAndWhatIsWrongWithItAreInSight) {
    window.frame().showDock("plots");
    for (const char* text : {"ball.speed > 2", "kick", "goal"}) ASSERT_TRUE(window.breakpointPanel().add(text));
    window.resize(1280, 560);
    window.activateWindow();
    settleLayout();
    auto* line = window.findChild<QLineEdit*>("breakpoint_line");
    auto* told = window.findChild<QLabel*>("breakpoint_reply");
    auto* area = dock("breakpoints").findChild<QScrollArea*>();
    // As much as scrolling can tell.
    area->setFixedHeight(90);
    settleLayout();
    key(Qt::Key_F8);
    settleLayout();
    EXPECT_TRUE(seenWhole(*line));
    QTest::keyClicks(line, "robot[2.speed >");
    QTest::keyClick(line, Qt::Key_Return);
    settleLayout();
    EXPECT_FALSE(told->text().isEmpty());
    EXPECT_TRUE(seenWhole(*line));
    EXPECT_TRUE(seenWhole(*told)) << told->visibleRegion().boundingRect().height() << " of " << told->height();
}

TEST_F(RoomTest, FirstStepsFoldWhereTheyAreHigherThanTheField) {
    auto* card = window.findChild<FirstSteps*>();
    auto* button = window.findChild<QToolButton*>("first_steps_button");
    move(2);
    window.actions()["first_steps"].trigger();
    int folded = 0;
    const auto check = [&](const char* what) {
        settleLayout();
        FieldView& field = window.field();
        EXPECT_NE(card->isVisible(), button->isVisible()) << what;
        if (!card->isVisible()) {
            ++folded;
            return;
        }
        EXPECT_TRUE(field.rect().contains(card->geometry())) << what;
        EXPECT_GE(card->height(), card->sizeHint().height()) << what;
        EXPECT_LE(4 * card->width() * card->height(), field.width() * field.height()) << what;
    };
    check("at first");
    key(Qt::Key_S);
    check("side by side");
    window.frame().showDock("plots");
    check("with plots");
    window.resize(1024, 640);
    check("small");
    if (button->isVisible()) QTest::mouseClick(button, Qt::LeftButton);
    settleLayout();
    EXPECT_TRUE(button->isVisible()) << "there is no room for it at all";
    EXPECT_GT(folded, 1);
}

TEST_F(RoomTest, SideBySideTakesTheLargerOfBothArrangements) {
    move(2);
    key(Qt::Key_S);
    for (const bool plots : {false, true})
        for (const QSize size : {QSize(1280, 800), QSize(1600, 800), QSize(1100, 1000)}) {
            if (plots) window.frame().showDock("plots");
            window.resize(size);
            settleLayout();
            key(Qt::Key_F);
            FieldView &here = window.field(), &there = window.view().beside();
            const bool across = here.mapTo(&window, QPoint()).y() == there.mapTo(&window, QPoint()).y();
            const double w = across ? here.width() * 2 : here.width(), h = across ? here.height() : here.height() * 2;
            const double other =
                across ? here.viewport().fittedScale({w, h / 2 - 14}) : here.viewport().fittedScale({w / 2, h + 27});
            EXPECT_GE(here.transform().scale(), 0.97 * other) << size.width() << (plots ? " with plots" : "");
        }
}

TEST_F(RoomTest, SideBySideKeepsWhereOneLooks) {
    move(2);
    window.field().viewport().zoom(3);
    window.field().viewport().pan({70, 40});
    const ViewTransform before = window.field().transform();
    key(Qt::Key_S);
    EXPECT_EQ(window.field().transform().scale(), before.scale());
    EXPECT_EQ(window.view().beside().transform().scale(), before.scale());
    EXPECT_EQ(window.view().beside().transform().centre().x, before.centre().x);
    key(Qt::Key_S);
    EXPECT_TRUE(window.field().transform() == before);
}

TEST_F(RoomTest, PanelsHaveTheirSizeAgainInALargeWindow) {
    window.frame().showDock("plots");
    settleLayout();
    std::map<std::string, QSize> before;
    for (const char* name : {"branches", "inspector", "plots"}) before[name] = dock(name).size();
    EXPECT_GE(dock("plots").height(), 230);
    for (const QSize small : {QSize(640, 480), QSize(300, 200)}) {
        window.resize(small);
        settleLayout();
        window.resize(1280, 800);
        settleLayout();
        EXPECT_EQ(dock("inspector").width(), before["inspector"].width());
        EXPECT_EQ(dock("branches").width(), before["branches"].width());
        EXPECT_EQ(dock("plots").height(), before["plots"].height());
    }
    // Also where they were opened in the small one.
    dock("plots").hide();
    window.resize(640, 480);
    settleLayout();
    window.frame().showDock("plots");
    settleLayout();
    window.resize(1280, 800);
    settleLayout();
    EXPECT_GE(dock("plots").height(), 200);
    EXPECT_EQ(dock("inspector").width(), before["inspector"].width());
}

TEST_F(RoomTest, MessageOverTheFieldLeavesTheFirstStepsFree) {
    window.actions()["first_steps"].trigger();
    settleLayout();
    auto* card = window.findChild<FirstSteps*>();
    for (const QSize size : {QSize(1280, 800), QSize(1600, 900)}) {
        window.resize(size);
        settleLayout();
        window.frame().say(QString("something that is %1 of words ").arg(size.width()).repeated(4));
        settleLayout();
        ASSERT_TRUE(window.frame().status.quietMessage().isVisible());
        const QRect about =
            card->isVisible() ? card->geometry() : window.findChild<QToolButton*>("first_steps_button")->geometry();
        EXPECT_FALSE(window.frame().status.quietMessage().geometry().intersects(about)) << size.width();
        EXPECT_TRUE(window.field().rect().contains(window.frame().status.quietMessage().geometry()));
    }
}

}  // namespace
}  // namespace mrose::gui
