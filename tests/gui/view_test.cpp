#include <algorithm>
#include <numbers>

#include "gui/window_fixture.h"
#include "widgets/field_fixture.h"
#include "widgets/timeline_bar.h"

namespace mrose::gui {
namespace {

TEST_F(WindowTest, RobotsAreSeenWhereTheyAreAfterEveryJump) {
    window.field().setLayers(FieldLayers::none());
    for (const std::int64_t tick : {0, 137, 400, 90}) {
        window.session().seek(tick);
        settle();
        ASSERT_EQ(state().tick, tick);
        window.field().setSelected(0);
        const QImage before = rendered(window.field());
        for (std::size_t robot = 0; robot < 8; ++robot) {
            const QColor body = before.pixelColor(pixelOf(robot).toPoint());
            const bool red = window.shown()->frame->nameOf(robot).starts_with("red");
            EXPECT_GT(red ? body.red() : body.blue(), red ? body.blue() : body.red()) << robot << " at " << tick;
        }
    }
}

TEST_F(WindowTest, KeysSwitchLayers) {
    for (const FieldLayerText& layer : fieldLayerTexts) {
        const bool before = window.field().layers().has(layer.layer);
        QTest::keyClick(&window, layer.key[0]);
        EXPECT_NE(window.field().layers().has(layer.layer), before) << layer.name;
        EXPECT_EQ(window.actions()[layer.action].isChecked(), !before) << layer.name;
    }
}

TEST_F(WindowTest, KeysMoveTheView) {
    const ViewTransform fitted = window.field().transform();
    key(Qt::Key_Right, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_GT(window.field().transform().centre().x, fitted.centre().x);
    key(Qt::Key_Up, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_GT(window.field().transform().centre().y, fitted.centre().y);
    key(Qt::Key_F);
    EXPECT_TRUE(window.field().transform() == fitted);
}

TEST_F(WindowTest, NudgesWithAltHeldAreOneBranch) {
    window.session().seek(100);
    settle();
    window.field().setSelected(2);
    const Pose before = state().robots[2].pose;
    // keyClick() would press and release the Alt key each time.
    const auto type = [&](Qt::Key key, Qt::KeyboardModifiers modifiers) {
        for (const bool press : {true, false}) QTest::simulateEvent(&window, press, key, modifiers, {}, false);
    };
    QTest::simulateEvent(&window, true, Qt::Key_Alt, {}, {}, false);
    for (int i = 0; i < 5; ++i) type(Qt::Key_Up, Qt::AltModifier);
    for (int i = 0; i < 3; ++i) type(Qt::Key_Left, Qt::AltModifier | Qt::ShiftModifier);
    EXPECT_EQ(window.shown()->branches.size(), 1u) << "as long as Alt is held";
    QTest::simulateEvent(&window, false, Qt::Key_Alt, {}, {}, false);
    settle();
    const Pose after = state().robots[2].pose;
    EXPECT_NEAR(after.x, before.x, 1e-12);
    EXPECT_NEAR(after.y, before.y + 0.05, 1e-12);
    EXPECT_NEAR(wrapAngle(after.heading - before.heading), 3 * std::numbers::pi / 180, 1e-12);
    EXPECT_EQ(window.shown()->branches.size(), 2u);
}

TEST_F(WindowTest, KeysGoFromMarkToMark) {
    window.session().seek(400);
    settle();
    key(Qt::Key_Comma);
    const std::vector<TimelineMark>& marks = *window.shown()->marks;
    ASSERT_FALSE(marks.empty());
    const auto isMark = [&](std::int64_t tick, bool contacts) {
        return std::any_of(marks.begin(), marks.end(), [&](const TimelineMark& mark) {
            return mark.tick == tick && (contacts || mark.kind != TimelineMark::Kind::contact);
        });
    };
    EXPECT_LT(state().tick, 400);
    EXPECT_TRUE(isMark(state().tick, true));
    key(Qt::Key_Comma, Qt::ControlModifier);
    const std::int64_t kick = state().tick;
    EXPECT_TRUE(isMark(kick, false));
    key(Qt::Key_Period);
    EXPECT_GT(state().tick, kick);
    EXPECT_TRUE(isMark(state().tick, true));
}

TEST_F(WindowTest, TrailsAreWhereBodiesWereAlsoBeforeABranch) {
    std::vector<Point> ways;
    StepBuffers buffers;
    WorldState expected = window.shown()->frame->scenario->initialState();
    for (int i = 0; i < 200; ++i) {
        ways.push_back(position(expected.robots[4].pose));
        step(*window.shown()->frame->scenario, expected, buffers);
    }
    window.session().seek(150);
    settle();
    drag(pixelOf(2), pixelOf(2) + QPointF(30, 20));
    for (int i = 0; i < 40; ++i) window.session().stepBy(1);
    settle();
    const Trails& trails = window.shown()->frame->trails;
    EXPECT_EQ(trails.ticks(), 151u + 41u);
    std::size_t i = 0;
    trails.visit(4, [&](const Point& point, bool begins) {
        const std::size_t tick = i <= 150 ? i : i - 1;  // the branch's first tick is that in which it departed
        EXPECT_EQ(begins, i == 0 || i == 151) << i;
        if (tick <= 150) {
            EXPECT_NEAR(point.x, ways[tick].x, 1e-6) << i;
        }
        ++i;
    });
    key(Qt::Key_T, Qt::ControlModifier);
    key(Qt::Key_T, Qt::ControlModifier);
    EXPECT_EQ(window.shown()->frame->trails.ticks(), 101u + 1u) << "two seconds";
}

TEST_F(WindowTest, DoubleClickFollows) {
    window.session().seek(100);
    settle();
    QTest::mouseDClick(&window.field(), Qt::LeftButton, {}, pixelOf(1).toPoint());
    EXPECT_TRUE(window.actions()["follow"].isChecked());
    window.session().seek(160);
    settle();
    EXPECT_EQ(window.field().transform().centre(), position(state().robots[1].pose));
}

}  // namespace
}  // namespace mrose::gui
