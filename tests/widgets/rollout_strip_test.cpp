#include "widgets/rollout_strip.h"

#include <QApplication>
#include <QFontMetricsF>

#include <gtest/gtest.h>

#include "widgets/fixed_text.h"

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
    EXPECT_TRUE(strip.shownTitle().contains("14:51.9")) << strip.shownTitle().toStdString();
}

TEST(RolloutStrip, ScaleSaysWhereItEndsThatSomeAreOffByMore) {
    RolloutStrip strip;
    RolloutStrip::Content content = contentOf("create 3");
    strip.setContent(content);
    EXPECT_EQ(strip.worstText().toStdString(), "\u2265 7.6 cm");
    for (RolloutStrip::Cell& cell : content.cells) cell.error = 0.02;
    strip.setContent(content);
    EXPECT_EQ(strip.worstText().toStdString(), "2.0 cm");
}

TEST(RolloutStrip, TimesOfALogHaveOneForm) {
    EXPECT_EQ(logTimeText(0), "0:00.0");
    EXPECT_EQ(logTimeText(fromSeconds(9.96)), "0:10.0");
    EXPECT_EQ(logTimeText(fromSeconds(59.97)), "1:00.0");
    EXPECT_EQ(logTimeText(fromSeconds(760)), "12:40.0");
    EXPECT_EQ(logTimeText(fromSeconds(3662.4)), "1:01:02.4");
    RolloutStrip strip;
    strip.resize(900, strip.sizeHint().height());
    strip.setContent(contentOf("create 3"));
    EXPECT_TRUE(strip.textAt(strip.pixelOf(10)).startsWith("1:50.0 to 2:01.0"))
        << strip.textAt(strip.pixelOf(10)).toStdString();
}

}  // namespace
}  // namespace mrose
