// Where robots may be, as it is drawn and said.
#include <gtest/gtest.h>

#include "widgets/field_drawing.h"
#include "widgets/field_fixture.h"
#include "widgets/field_view.h"

namespace mrose {
namespace {

/// From (-2, 0) on at 1 m/s: as wide across as long, 0.2 m and 0.5 m about the way; of the second robot nothing.
std::shared_ptr<const MotionBands> straightBands(std::int64_t tick) {
    MotionBands bands{tick, 5, {{}, {}}};
    for (int i = 0; i <= 40; ++i) {
        PoseRegion region;
        region.centre = {-2 + 0.1 * i, 0};
        region.xx = region.yy = 0.01;
        region.extents[0].radius = 2;
        region.extents[1].radius = 5;
        region.extents[1].heading = {-0.1, 0.1};
        bands.regions[0].push_back(region);
    }
    return std::make_shared<const MotionBands>(std::move(bands));
}

class FieldBandsTest : public testing::Test {
protected:
    FieldBandsTest() {
        view.setSize({800, 640});
        view.fit({{-5, -4}, {5, 4}}, QRectF(0, 0, 800, 640));
        frame.state.tick = 100;
        focus.bands = {straightBands(100), false};
    }
    QImage picture() const { return paintedFrame(frame, view, only({FieldLayer::uncertainty}), focus); }
    /// How far a colour there is from that of the floor.
    int tint(const QImage& image, const Point& at) const {
        const QPoint pixel = view.toPixels(at).toPoint(), floor = view.toPixels({0, -3}).toPoint();
        const QColor a = image.pixelColor(pixel), b = image.pixelColor(floor);
        return std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue());
    }

    ViewTransform view;
    FieldFrame frame = frameOfDiscs({{-4, 2, 0}, {4, 2, 0}});
    FieldFocus focus;
};

TEST_F(FieldBandsTest, InnerBandIsStrongerThanTheOuterAndTheFieldBeyondIsClear) {
    const QImage image = picture();
    const int inner = tint(image, {0.52, 0.1}), outer = tint(image, {0.52, 0.35});
    EXPECT_GT(outer, 15);
    EXPECT_GT(inner, outer + 15);
    EXPECT_EQ(tint(image, {0.52, 0.6}), 0);
    EXPECT_EQ(tint(image, {-2.6, 0}), 0) << "before its start";
    EXPECT_EQ(tint(image, {2.6, 0}), 0) << "beyond its end";
    EXPECT_EQ(tint(image, {0, -0.35}), tint(image, {-0.73, -0.35})) << "where pieces overlap as elsewhere";
}

TEST_F(FieldBandsTest, WhatLiesBehindIsShownOfAllOfARunAlone) {
    frame.state.tick = 200;
    EXPECT_EQ(tint(picture(), {-1.5, 0.35}), 0);
    EXPECT_GT(tint(picture(), {1.5, 0.35}), 15);
    auto block = std::make_shared<TrailBlock>(3);
    for (int i = 0; i < 3; ++i) frame.trails.pieces.push_back({block, 0, TrailBlock::capacity});
    focus.bands.ofRun = true;
    EXPECT_GT(tint(picture(), {-1.5, 0.35}), 15);
    // The ring about where it may be now.
    EXPECT_GT(tint(picture(), {0, 0.5}), tint(picture(), {0.52, 0.35}) + 40);
}

TEST_F(FieldBandsTest, ThoseOfOtherTicksSayNothing) {
    for (const std::int64_t tick : {99, 301}) {
        frame.state.tick = tick;
        EXPECT_FALSE(focus.bands.tellOf(frame));
        EXPECT_EQ(tint(picture(), {0.52, 0.1}), 0);
        EXPECT_TRUE(bandReadout(frame, focus.bands, 0).isEmpty());
    }
    focus.bands.bands = nullptr;
    EXPECT_FALSE(focus.bands.tellOf(frame));
}

TEST_F(FieldBandsTest, TipSaysHowFarItMayBeOff) {
    frame.state.tick = 150;
    const std::string text = bandReadout(frame, focus.bands, 0).toStdString();
    EXPECT_NE(text.find("may be in 3.0 s"), std::string::npos) << text;
    EXPECT_NE(text.find("50 %: \u00b120 cm by \u00b120 cm"), std::string::npos) << text;
    EXPECT_NE(text.find("90 %: \u00b150 cm by \u00b150 cm, \u00b15.7\u00b0"), std::string::npos) << text;
    EXPECT_EQ(bandReadout(frame, focus.bands, 1).toStdString(), "no noise of its motion is known");
    EXPECT_TRUE(bandReadout(frame, focus.bands, 2).isEmpty()) << "the ball";
}

TEST_F(FieldBandsTest, EndOfTheSelectedOneSaysHowFarAheadItIs) {
    const QImage none = picture();
    focus.selected = 0;
    const QPointF end = view.toPixels({2.5, 0});
    const auto changed = [&] {
        const auto all = differences(none, picture());
        return std::count_if(all.begin(), all.end(),
                             [&](const QPoint& p) { return QLineF(p, end + QPointF(28, 0)).length() < 25; });
    };
    EXPECT_GT(changed(), 50);
    focus.covered = QRectF(end, QSizeF(60, 30));
    EXPECT_LT(changed(), 50) << "under something else there is no half of a label";
    focus.covered = {};
    focus.selected = 1;
    EXPECT_LT(tint(picture(), {0.52, 0.1}), tint(none, {0.52, 0.1})) << "another one is looked at";
}

}  // namespace
}  // namespace mrose
