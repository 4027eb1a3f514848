#include "widgets/way_line.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace mrose {
namespace {

double fromWay(const QPointF& p, const QPolygonF& line) {
    double least = 1e9;
    for (int i = 0; i + 1 < line.size(); ++i) {
        const QPointF along = line[i + 1] - line[i], by = p - line[i];
        const double square = QPointF::dotProduct(along, along);
        const double share = square > 0 ? std::clamp(QPointF::dotProduct(by, along) / square, 0.0, 1.0) : 0;
        least = std::min(least, std::hypot((by - share * along).x(), (by - share * along).y()));
    }
    return least;
}

TEST(WayLine, FewPointsStayWithinAPixelOfAll) {
    std::vector<QPointF> points;
    for (int i = 0; i < 3000; ++i) {
        const double t = 0.004 * i;  // a straight, loops, a reversal and a stop
        if (t < 3)
            points.emplace_back(100 * t, 0);
        else if (t < 8)
            points.emplace_back(300 + 40 * std::sin(3 * t) + 10 * t, 60 * std::cos(2 * t));
        else if (t < 9)
            points.emplace_back(400 - 100 * (t - 8), 30);
        else
            points.emplace_back(300, 30);
    }
    WayLine way;
    for (const QPointF& point : points) way.add(point);
    const auto lines = way.lines();
    ASSERT_EQ(lines.size(), 1);
    EXPECT_LT(lines[0].size(), 350);
    EXPECT_EQ(lines[0].front(), points.front());
    EXPECT_EQ(lines[0].back(), points.back());
    for (const QPointF& point : points) EXPECT_LE(fromWay(point, lines[0]), 1.1);
}

TEST(WayLine, BeginsAnewWithoutALineBetween) {
    WayLine way;
    for (const double x : {0.0, 5.0, 10.0}) way.add({x, 0});
    way.begin();
    for (const double x : {50.0, 60.0}) way.add({x, 9});
    const auto lines = way.lines();
    ASSERT_EQ(lines.size(), 2);
    EXPECT_EQ(lines[0].back(), QPointF(10, 0));
    EXPECT_EQ(lines[1].front(), QPointF(50, 9));
    EXPECT_EQ(lines[1].back(), QPointF(60, 9));
}

}  // namespace
}  // namespace mrose
