// What the legend lists, and where it stands.
#include "widgets/field_legend.h"

#include <QImage>
#include <QPainter>
#include <set>

#include <gtest/gtest.h>

#include "widgets/field_fixture.h"
#include "widgets/field_painter.h"

namespace mrose {
namespace {

class FieldLegendTest : public testing::Test {
protected:
    FieldLegendTest() {
        view.setSize({800, 640});
        view.fit({{-5, -4}, {5, 4}}, {0, 0, 800, 640});
        for (const FieldLayerText& text : fieldLayerTexts) layers.set(text.layer, true);
    }
    void paint(const FieldFrame& frame, const FieldFocus& focus = {}) {
        QImage image(800, 640, QImage::Format_RGB32);
        QPainter painter(&image);
        LabelPlacer labels;
        const Theme theme = Theme::light();
        FieldPainter field(painter, view, theme, layers);
        field.frame(frame, focus, labels, legend);
        field.corners(frame, legend);
    }
    FieldFrame laterBy(FieldFrame frame, std::int64_t ticks) const {
        frame.state.tick += ticks;
        return frame;
    }

    ViewTransform view;
    FieldLayers layers;
    FieldLegend legend;
};

TEST_F(FieldLegendTest, ListsWhatIsDrawnAndKeepsItWhileTheRunGoesOn) {
    FieldFrame frame = frameOfDiscs({{0, 0, 0}});
    paint(frame);
    EXPECT_TRUE(legend.lists(FieldLayer::headings));
    for (const FieldLayer layer : {FieldLayer::contacts, FieldLayer::ghosts, FieldLayer::targets, FieldLayer::predicted,
                                   FieldLayer::reality, FieldLayer::models})
        EXPECT_FALSE(legend.lists(layer)) << static_cast<int>(layer);
    const QSizeF before = legend.box().size();
    FieldFrame touching = laterBy(frame, 1);
    touching.lastTick.contacts = {{0, 1, 0, {0, 3}, {1, 0}, 0.02}};
    paint(touching);
    EXPECT_TRUE(legend.lists(FieldLayer::contacts));
    EXPECT_GT(legend.box().height(), before.height());
    // It does not come and go with each touch, but it goes with the moment.
    paint(laterBy(frame, 2));
    EXPECT_TRUE(legend.lists(FieldLayer::contacts));
    paint(frame);
    EXPECT_FALSE(legend.lists(FieldLayer::contacts));
    layers.set(FieldLayer::headings, false);
    paint(frame);
    EXPECT_TRUE(legend.box().isEmpty());
}

TEST_F(FieldLegendTest, StandsWhereItHidesLeastAndStaysThere) {
    const auto hidden = [&](const FieldFrame& frame, std::size_t body) {
        return legend.box().contains(view.toPixels(position(frame.poseOf(body))));
    };
    FieldFrame frame = frameOfDiscs({{-4.5, -3.5, 0}, {0, 0, 0}});
    FieldFocus focus;
    paint(frame, focus);
    const QRectF right = legend.box();
    EXPECT_GT(right.left(), 400);
    EXPECT_GT(right.top(), 320);
    // The selected one is chosen for; who only passes below it does not drive it away.
    frame.state.robots[1].pose = {4.5, -3.4, 0};
    paint(laterBy(frame, 1), focus);
    EXPECT_EQ(legend.box(), right);
    focus.selected = 1;
    paint(laterBy(frame, 2), focus);
    EXPECT_NE(legend.box(), right);
    EXPECT_FALSE(hidden(frame, 1));
}

/// In a picture of half a window: those that differ have names, but not so many that the field is not seen.
TEST_F(FieldLegendTest, TwoFieldsSideBySideShowTheNamesThatFit) {
    std::vector<Pose> poses;
    for (int i = 0; i < 12; ++i) poses.push_back({0.7 * i - 4, 0, 0});
    const FieldFrame frame = frameOfDiscs(poses);
    FieldFocus focus;
    QImage image(300, 240, QImage::Format_RGB32);
    QPainter painter(&image);
    view.setSize({300, 240});
    view.fit({{-5, -4}, {5, 4}}, {0, 0, 300, 240});
    const Theme theme = Theme::light();
    const FieldCanvas canvas{painter, view, theme};
    const auto named = [&] {
        std::vector<FieldLabel> labels;
        addNames(canvas, frame, focus, labels);
        std::set<std::uint64_t> bodies;
        for (const FieldLabel& label : labels) bodies.insert(label.key & 0xff);
        return bodies;
    };
    EXPECT_EQ(named().size(), 12u) << "alone all but the ball, which is too small there";
    focus.elsewhere.resize(13);
    focus.elsewhere[9] = Point{0, 0};
    focus.selected = 7;
    const std::set<std::uint64_t> beside = named();
    EXPECT_LT(beside.size(), 8u);
    EXPECT_TRUE(beside.count(9) == 1 && beside.count(7) == 1);
}

}  // namespace
}  // namespace mrose
