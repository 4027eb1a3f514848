// How much room the panels take of the field, and where they lie again.
#include "frame/docks.h"

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QLabel>
#include <QMouseEvent>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QTabBar>
#include <cmath>

#include "frame/window_memory.h"
#include "gui/overlay_fixture.h"
#include "panels/side_view.h"
#include "widgets/field_view.h"
#include "widgets/inspector.h"

namespace mrose::gui {
namespace {

class DocksTest : public OverlayTest {
protected:
    std::unique_ptr<QSettings> settings() {
        return std::make_unique<QSettings>(qPath("settings.ini"), QSettings::IniFormat);
    }
    QDockWidget& dock(const char* name) { return *window.findChild<QDockWidget*>(name); }
    void openGame() {
        ASSERT_TRUE(window.files().openNow({"soccer.toml"}));
        settleAll();
    }
    void resizeTo(const QSize& size) {
        window.resize(size);
        settleAll();
    }
    void expectRoomForTheField(const char* view) {
        const QSize all = window.size();
        ASSERT_EQ(window.minimumSizeHint().expandedTo(all), all) << view;
        EXPECT_GE(window.field().width(), Docks::leastFieldWidth * all.width()) << view << " at " << all.width();
        EXPECT_GE(window.field().height(), Docks::leastFieldHeight * all.height()) << view << " at " << all.width();
    }
};

constexpr QSize sizes[] = {{1024, 620}, {1280, 800}, {1920, 1080}};

TEST_F(DocksTest, AGameKeepsItsLayoutWhateverIsDoneWithALog) {
    window.frame().memory.restore(settings());
    ASSERT_NO_FATAL_FAILURE(openGame());
    dock("command").close();
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    EXPECT_TRUE(dock("reality").isVisible());
    EXPECT_TRUE(dock("plots").isVisible());
    dock("inspector").close();
    window.close();

    MainWindow later;
    later.frame().memory.restore(settings());
    later.QWidget::show();
    ASSERT_TRUE(later.files().openNow({"soccer.toml"}));
    gui::settle(later.scripted());
    const auto shown = [&](const char* name) { return later.findChild<QDockWidget*>(name)->isVisible(); };
    for (const char* name : {"branches", "breakpoints", "inspector"}) EXPECT_TRUE(shown(name)) << name;
    for (const char* name : {"reality", "plots", "command"}) EXPECT_FALSE(shown(name)) << name;
    for (const QTabBar* tabs : later.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly))
        EXPECT_FALSE(tabs->isVisible());
    // And the log its own.
    ASSERT_TRUE(later.overlay().openNow({shipped(), ""}));
    later.overlay().settle();
    gui::settle(later.scripted());
    for (const char* name : {"reality", "plots"}) EXPECT_TRUE(shown(name)) << name;
    EXPECT_FALSE(shown("inspector"));
    for (const QTabBar* tabs : later.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
        EXPECT_TRUE(tabs->isVisible());
        EXPECT_EQ(tabs->shape(), QTabBar::RoundedWest);
    }
    later.overlay().close();
    gui::settle(later.scripted());
    EXPECT_FALSE(shown("reality") || shown("plots"));
    EXPECT_TRUE(shown("inspector"));
}

TEST_F(DocksTest, InspectorTakesNoWidthOfTheFieldWhileNothingIsSelected) {
    ASSERT_NO_FATAL_FAILURE(openGame());
    constexpr int bar = 30;  // pixels
    EXPECT_LE(dock("inspector").width(), bar);
    EXPECT_GE(dock("inspector").height(), window.field().height());
    const int wide = window.field().width();
    window.field().setSelected(2);
    settleAll();
    EXPECT_EQ(dock("inspector").width(), 330);
    EXPECT_LT(window.field().width(), wide);
    window.field().setSelected(std::nullopt);
    settleAll();
    EXPECT_LE(dock("inspector").width(), bar);
    EXPECT_EQ(window.field().width(), wide);
    // As wide again as the user made it.
    window.field().setSelected(2);
    settleAll();
    const QPoint at(dock("inspector").x() - 2, 300), to = at - QPoint(60, 0);
    QTest::mousePress(&window, Qt::LeftButton, {}, at);
    for (const QPoint& place : {at - QPoint(20, 0), to}) {
        QMouseEvent move(QEvent::MouseMove, place, window.mapToGlobal(place), Qt::NoButton, Qt::LeftButton, {});
        QApplication::sendEvent(&window, &move);
        settleAll();
    }
    QTest::mouseRelease(&window, Qt::LeftButton, {}, to);
    EXPECT_NEAR(dock("inspector").width(), 390, 3);
    const int own = dock("inspector").width();
    window.field().setSelected(std::nullopt);
    settleAll();
    window.field().setSelected(1);
    settleAll();
    EXPECT_EQ(dock("inspector").width(), own);
}

TEST_F(DocksTest, NothingMovesUnderTheMouse) {
    ASSERT_NO_FATAL_FAILURE(openGame());
    FieldView& field = window.field();
    const Pose& pose = window.shown()->frame->poseOf(2);
    const QPoint at = field.transform().toPixels({pose.x, pose.y}).toPoint();
    const ViewTransform before = field.transform();
    QTest::mousePress(&field, Qt::LeftButton, {}, at);
    settleAll();
    ASSERT_EQ(field.selected(), 2u);
    QTest::qWait(QApplication::doubleClickInterval() + 50);
    EXPECT_TRUE(field.transform() == before) << "it is held";
    QTest::mouseRelease(&field, Qt::LeftButton, {}, at);
    settleAll();
    EXPECT_TRUE(field.transform() == before) << "a second click may follow";
    QTest::qWait(2 * QApplication::doubleClickInterval() + 100);
    settleAll();
    EXPECT_GT(dock("inspector").width(), 200);
}

TEST_F(DocksTest, FieldKeepsItsShareOfEachWindow) {
    ASSERT_NO_FATAL_FAILURE(openGame());
    for (const QSize& size : sizes) {
        resizeTo(size);
        expectRoomForTheField("game");
    }
    window.field().setSelected(2);
    window.frame().showDock("plots");
    for (const QSize& size : sizes) {
        resizeTo(size);
        expectRoomForTheField("game with inspector and plots");
    }
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    for (const QSize& size : sizes) {
        resizeTo(size);
        expectRoomForTheField("log");
    }
    clickLine(0);
    window.field().setSelected(0);
    settleAll();
    for (const QSize& size : sizes) {
        resizeTo(size);
        expectRoomForTheField("log with inspector and plots");
        // Where there is room for all that is in the panel, it need not be scrolled.
        const auto& panel = static_cast<const QScrollArea&>(*dock("reality").widget());
        if (size.width() >= 1280) {
            EXPECT_EQ(panel.horizontalScrollBar()->maximum(), 0) << size.width();
        }
    }
}

TEST_F(DocksTest, BothFieldsSideBySideUseTheirRoom) {
    ASSERT_NO_FATAL_FAILURE(openGame());
    window.session().seek(50);
    settleAll();
    window.session().branchOff(moveBody(*window.shown()->frame, 2, {0, 1, 0}));
    settleAll();
    QTest::keyClick(&window, Qt::Key_S);
    settleAll();
    for (const QSize& size : sizes) {
        resizeTo(size);
        ASSERT_TRUE(window.view().beside().isVisible());
        FieldView& field = window.field();
        const bool across = field.mapTo(&window, QPoint()).y() == window.view().beside().mapTo(&window, QPoint()).y();
        if (across) {
            EXPECT_GE(2 * field.width(), Docks::leastFieldWidth * size.width() - 4) << size.width();
            EXPECT_GE(field.viewport().fittedPlace().width(), 0.85 * field.width()) << size.width();
        } else {
            EXPECT_GE(field.width(), Docks::leastFieldWidth * size.width()) << size.width();
            EXPECT_GE(field.viewport().fittedPlace().height(), 0.7 * field.height()) << size.width();
        }
    }
}

/// The run alone is no list of branches.
TEST_F(DocksTest, EmptyListOfBranchesLeavesItsRoomToTheBreakpoints) {
    ASSERT_NO_FATAL_FAILURE(openGame());
    resizeTo({1280, 800});
    const int alone = dock("branches").height(), breaks = dock("breakpoints").height();
    EXPECT_LT(alone, 160);
    EXPECT_GT(breaks, 200);
    EXPECT_TRUE(dock("branches").findChild<QLabel*>()->isVisible());
    const auto* area = static_cast<const QScrollArea*>(dock("branches").widget());
    EXPECT_EQ(area->verticalScrollBar()->maximum(), 0) << "what it says is whole";
    window.session().seek(100);
    settleAll();
    window.session().branchOff(moveBody(*window.shown()->frame, 2, {0, 1, 0}));
    settleAll();
    QTest::qWait(QApplication::doubleClickInterval() + 50);
    settleAll();
    EXPECT_GT(dock("branches").height(), alone);
    EXPECT_LT(dock("breakpoints").height(), breaks);
}

TEST_F(DocksTest, ResetLayoutLeavesAMaximisedWindowItsSize) {
    ASSERT_NO_FATAL_FAILURE(openGame());
    window.showMaximized();
    settleAll();
    ASSERT_TRUE(window.isMaximized());
    const QSize all = window.size();
    dock("branches").hide();
    window.actions()["reset_layout"].trigger();
    settleAll();
    EXPECT_TRUE(window.isMaximized());
    EXPECT_EQ(window.size(), all);
    EXPECT_TRUE(dock("branches").isVisible());
    window.actions()["full_screen"].trigger();
    window.actions()["reset_layout"].trigger();
    EXPECT_TRUE(window.isFullScreen());
}

}  // namespace
}  // namespace mrose::gui
