#include "widgets/field_viewport.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mrose
