#include "widgets/rollout_strip.h"

#include <QApplication>
#include <QFontMetricsF>

#include <gtest/gtest.h>

namespace mrose {
namespace {

RolloutStrip::Content contentOf(const QString& title) {
    RolloutStrip::Content content;
    content.title = title;
    content.length = fromSeconds(891.88);
    for (std::size_t i = 0; i < 80; ++i)
        content.cells.push_back({i, fromSeconds(11.0 * i), fromSeconds(11.0 * i + 11), 0.001 * i});
    return content;
}

TEST(RolloutStrip, TitleAndLegendLeaveEachOtherRoomAtAnyWidth) {
    RolloutStrip strip;
    strip.setContent(contentOf("create 3 in MRCLAM_Dataset6"));
    QFont small = strip.font();
    small.setPointSizeF(0.85 * small.pointSizeF());
    for (const int width : {200, 305, 470, 900}) {
        strip.resize(width, strip.sizeHint().height());
        const QRectF legend = strip.legendRoom();
        EXPECT_LE(18 + QFontMetricsF(small).horizontalAdvance(strip.shownTitle()), legend.left()) << width;
        EXPECT_LE(legend.right(), width);
        // The colours take no room of the rollouts.
        EXPECT_GT(strip.pixelOf(79), 0.95 * width - 18) << width;
    }
    EXPECT_TRUE(strip.shownTitle().contains("14:51.88")) << strip.shownTitle().toStdString();
}

}  // namespace
}  // namespace mrose
