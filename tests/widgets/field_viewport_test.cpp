#include "widgets/field_viewport.h"

#include <numbers>

#include <gtest/gtest.h>

#include "widgets/field_drag.h"
#include "widgets/field_fixture.h"

namespace mrose {
namespace {

std::shared_ptr<const FieldFrame> frameAt(std::vector<Pose> poses) {
    return std::make_shared<const FieldFrame>(frameOfDiscs(std::move(poses)));
}

TEST(FieldViewport, FollowsTheSelectedBodyAndIsFittedNoLonger) {
    FieldViewport seen;
    seen.setSize({640, 480});
    seen.setFrame(frameAt({{0, 0, 0}, {2, 1, 0}}));
    EXPECT_TRUE(seen.showsAll());
    seen.setSelected(1);
    EXPECT_TRUE(seen.showsAll());
    seen.setFollowing(true);
    EXPECT_EQ(seen.transform().centre(), (Point{2, 1}));
    EXPECT_FALSE(seen.showsAll() || seen.fitted());
    seen.setFrame(frameAt({{0, 0, 0}, {-1, 3, 0}}));
    EXPECT_EQ(seen.transform().centre(), (Point{-1, 3}));
    seen.setFrame(frameAt({}));
    EXPECT_EQ(seen.transform().centre(), (Point{-1, 3})) << "that body is no more";
}

TEST(FieldViewport, PlaceIsTurnedWhereItIsMuchLargerThenUnlessTheUserTurnedIt) {
    FieldFrame frame = frameOfDiscs({{0, 0, 0}});
    ScenarioParts parts = frame.scenario->parts();
    Environment& arena = parts.scene.environment;
    arena.obstacles.clear();
    arena.markings.clear();
    arena.floor.area = {{-2, -1}, {2, -1}, {2, 9}, {-2, 9}};
    frame.scenario = std::make_shared<const Scenario>(std::move(parts));
    FieldViewport seen;
    seen.setSize({300, 600});
    seen.setFrame(std::make_shared<const FieldFrame>(frame));
    EXPECT_FALSE(seen.transform().turned());
    const double upright = seen.fittedScale({640, 480});
    seen.setSize({640, 480});
    EXPECT_TRUE(seen.transform().turned());
    EXPECT_GT(seen.transform().scale(), 1.3 * upright);
    const QRectF place = seen.fittedPlace();
    EXPECT_TRUE(QRectF(0, 0, 640, 480).contains(place));
    EXPECT_GT(place.width(), place.height());
    seen.setTurned(false);
    seen.setSize({640, 500});
    EXPECT_FALSE(seen.transform().turned()) << "chosen";
    seen.fit();
    EXPECT_TRUE(seen.transform().turned());
}

TEST(FieldViewport, RulersTakeRoomOfWhatIsFitted) {
    FieldViewport seen;
    seen.setSize({640, 480});
    seen.setFrame(frameAt({{0, 0, 0}}));
    const QRectF before = seen.fittedPlace();
    seen.setRulers(true);
    EXPECT_LT(seen.fittedPlace().height(), before.height());
    EXPECT_GT(seen.fittedPlace().left(), seen.margins().left() - 1e-9);
}

TEST(FieldViewport, SaysWhenSomethingElseIsSeen) {
    int fits = 0, others = 0;
    FieldViewport seen([&](bool fitted) { ++(fitted ? fits : others); });
    seen.fit();
    EXPECT_EQ(fits, 0) << "there is nothing yet";
    seen.setSize({640, 480});
    seen.setFrame(frameAt({{0, 0, 0}}));
    EXPECT_EQ(fits, 1);
    seen.zoom(2);
    seen.pan({5, 5});
    EXPECT_TRUE(seen.showLike(ViewTransform()));
    EXPECT_EQ(others, 3);
    EXPECT_FALSE(seen.showLike(seen.transform()));
    seen.fit();
    EXPECT_EQ(others, 3);
    EXPECT_EQ(fits, 2);
}

TEST(FieldDrag, ButtonAndPlaceSayWhatItIs) {
    using Kind = FieldDrag::Kind;
    FieldDrag left{Kind::pressed, Qt::LeftButton}, right{Kind::pressed, Qt::RightButton},
        middle{Kind::pressed, Qt::MiddleButton};
    EXPECT_EQ(left.dragged(true, true), Kind::move);
    EXPECT_EQ(right.dragged(true, true), Kind::turn);
    EXPECT_EQ(middle.dragged(true, true), Kind::pan);
    EXPECT_EQ(left.dragged(true, false), Kind::pan);
    EXPECT_EQ(left.dragged(false, true), Kind::pan);
    EXPECT_EQ(right.dragged(false, true), Kind::none);
    left.onKnob = true;
    EXPECT_EQ(left.dragged(true, true), Kind::turn);
}

TEST(FieldDrag, MovesByAsMuchAsTheMouseOrToRoundPlaces) {
    ViewTransform view;
    view.setSize({640, 480});
    const Pose pose{1.02, 0.51, 0.3};
    FieldDrag drag{FieldDrag::Kind::move, Qt::LeftButton};
    drag.from = view.toPixels({1, 0.5});
    drag.to = view.toPixels({1.35, 0.11});
    const Pose free = drag.posed(pose, view, false), round = drag.posed(pose, view, true);
    EXPECT_NEAR(free.x, 1.37, 1e-9);
    EXPECT_NEAR(free.y, 0.12, 1e-9);
    EXPECT_EQ(free.heading, 0.3);
    EXPECT_NEAR(round.x, 1.4, 1e-9);
    EXPECT_NEAR(round.y, 0.1, 1e-9);
}

TEST(FieldDrag, TurnsAlongWithWhereItWasTakenOrFacesTheCursor) {
    ViewTransform view;
    view.setSize({640, 480});
    const Pose pose{0, 0, 0.3};
    FieldDrag drag{FieldDrag::Kind::turn, Qt::RightButton};
    drag.from = view.toPixels({1, 0});
    drag.to = view.toPixels({0, 1});
    EXPECT_NEAR(drag.posed(pose, view, false).heading, 0.3 + std::numbers::pi / 2, 1e-9);
    EXPECT_NEAR(drag.posed(pose, view, true).heading, 7 * std::numbers::pi / 12, 1e-9);
    drag.from = view.toPixels({0.01, 0});
    EXPECT_NEAR(drag.posed(pose, view, false).heading, std::numbers::pi / 2, 1e-9);
}

}  // namespace
}  // namespace mrose
