#include <QListWidget>

#include "gui/window_fixture.h"
#include "widgets/field_fixture.h"
#include "widgets/message_bar.h"
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
    drag(pixelOf(2), pixelOf(2) + QPointF(40, 60));
    const double scale = window.field().transform().scale();
    EXPECT_EQ(window.shown()->branches.size(), 2u);
    EXPECT_NEAR(state().robots[2].pose.x, from.x + 40 / scale, 1e-9);
    EXPECT_NEAR(state().robots[2].pose.y, from.y - 60 / scale, 1e-9);
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(window.shown()->hash, before);
}

/// One list's selection is as loud as the keys that go to it; a ring says which that is.
TEST_F(WindowTest, FocusIsSeenOnFieldAndListsInBothThemes) {
    auto* breaks = window.findChild<QListWidget*>("breakpoint_list");
    ASSERT_NE(breaks, nullptr);
    EXPECT_TRUE(breaks->selectedItems().empty()) << "the one that is there from the beginning was not chosen";
    for (const bool dark : {false, true}) {
        if (window.actions()["dark"].isChecked() != dark) window.actions()["dark"].trigger();
        const Theme theme = dark ? Theme::darkOne() : Theme::light();
        const auto ringed = [&](QWidget& widget) {
            const QImage image = rendered(window);
            return image.pixelColor(widget.mapTo(&window, QPoint(1, widget.height() / 2))) == theme.accent &&
                   image.pixelColor(widget.mapTo(&window, QPoint(widget.width() / 2, 1))) == theme.accent;
        };
        window.activateWindow();
        window.field().setFocus();
        settle();
        EXPECT_TRUE(ringed(window.field()));
        const QColor quiet = breaks->palette().color(QPalette::Highlight);
        breaks->setFocus();
        settle();
        EXPECT_TRUE(ringed(*breaks));
        EXPECT_FALSE(ringed(window.field()));
        const QColor loud = breaks->palette().color(QPalette::Highlight);
        EXPECT_GT(contrast(loud, theme.panel), 1.5 * contrast(quiet, theme.panel)) << dark;
        EXPECT_GT(contrast(quiet, theme.text), 4.5) << dark;
        window.field().setFocus();
        settle();
        EXPECT_EQ(breaks->palette().color(QPalette::Highlight), quiet);
    }
}

TEST_F(WindowTest, MessagesDoNotMoveTheField) {
    const ViewTransform before = window.field().transform();
    const QRect place = window.field().geometry();
    EXPECT_FALSE(window.open("one_that_is_not_there.toml"));
    EXPECT_FALSE(window.open("another_that_is_not_there.toml"));
    settle();
    EXPECT_TRUE(window.field().transform() == before);
    EXPECT_EQ(window.field().geometry(), place);
    QStringList texts;
    for (const MessageBar::Message& message : window.messages().messages()) texts << message.text;
    const std::string all = texts.join('|').toStdString();
    EXPECT_NE(all.find("one_that"), std::string::npos) << all;
    EXPECT_NE(all.find("another_that"), std::string::npos) << all;
}

}  // namespace
}  // namespace mrose::gui
