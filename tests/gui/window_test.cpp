#include "gui/window_fixture.h"
#include "world/state_hash.h"

namespace mrose::gui {
namespace {

TEST_F(WindowTest, StepsToTheStatesOfStep) {
    const std::shared_ptr<const Scenario> scenario = window.shown()->frame->scenario;
    WorldState expected = scenario->initialState();
    StepBuffers buffers;
    for (int i = 0; i < 7; ++i) {
        step(*scenario, expected, buffers);
        key(Qt::Key_Right);
        EXPECT_EQ(window.shown()->hash, hashOf(expected)) << "tick " << i;
    }
    for (int i = 0; i < 3; ++i) key(Qt::Key_Left);
    EXPECT_EQ(state().tick, 4);
}

TEST_F(WindowTest, DraggedRobotStandsWhereItWasDroppedAndUndoTakesItBack) {
    window.session().seek(300);
    settle();
    const StateHash before = window.shown()->hash;
    const Pose from = state().robots[2].pose;
    drag(pixelOf(2), pixelOf(2) + QPointF(40, -30));
    const double scale = window.field().transform().scale();
    EXPECT_EQ(window.shown()->branches.size(), 2u);
    EXPECT_NEAR(state().robots[2].pose.x, from.x + 40 / scale, 1e-9);
    EXPECT_NEAR(state().robots[2].pose.y, from.y + 30 / scale, 1e-9);
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(window.shown()->hash, before);
}

}  // namespace
}  // namespace mrose::gui
