#include "widgets/timeline_bar.h"

#include <QApplication>
#include <QTest>
#include <QWheelEvent>
#include <limits>

#include <gtest/gtest.h>

#include "widgets/field_fixture.h"

namespace mrose {
namespace {

class TimelineBarTest : public testing::Test {
protected:
    void SetUp() override {
        bar.resize(1000, bar.sizeHint().height());
        content.last = 2000;
        content.end = 3000;
        content.now = 500;
    }
    void show(std::vector<TimelineMark> marks = {}) {
        content.marks = std::make_shared<const std::vector<TimelineMark>>(std::move(marks));
        bar.setContent(content);
    }
    /// Columns in which a picture has a colour, above `bottom`.
    std::vector<int> columnsOf(const QColor& colour, int bottom = 1000) {
        const QImage image = rendered(bar);
        std::vector<int> columns;
        for (int x = 0; x < image.width(); ++x)
            for (int y = 0; y < std::min(bottom, image.height()); ++y)
                if (image.pixelColor(x, y) == colour) {
                    columns.push_back(x);
                    break;
                }
        return columns;
    }

    TimelineBar bar;
    TimelineBar::Content content;
};

TEST_F(TimelineBarTest, PixelsAndTicksAreTheSameBothWays) {
    for (const std::int64_t end : {50, 3000, 180'000}) {
        content.end = content.last = end;
        content.first = end / 10;
        show();
        for (const double factor : {1.0, 7.0, 400.0}) {
            bar.zoom(factor, 321);
            const double perTick = bar.pixelOf(content.first + 1) - bar.pixelOf(content.first);
            for (const double pixel : {40.0, 321.0, 960.0})
                EXPECT_NEAR(bar.pixelOf(bar.tickAt(pixel)), pixel, perTick / 2 + 1e-6) << end << ' ' << factor;
            for (std::int64_t tick = content.first; tick <= end; tick += 1 + end / 97)
                EXPECT_EQ(bar.tickAt(bar.pixelOf(tick)), tick);
        }
        bar.zoom(1e-9, 0);
        EXPECT_EQ(bar.zoomed(), 1);
    }
}

TEST_F(TimelineBarTest, PressAndDragAskForTheTickUnderTheCursor) {
    show();
    std::vector<std::int64_t> asked;
    QObject::connect(&bar, &TimelineBar::tickRequested, [&](std::int64_t tick) { asked.push_back(tick); });
    const auto press = [&](double x) { return QPoint(static_cast<int>(x), 36); };
    QTest::mousePress(&bar, Qt::LeftButton, {}, press(bar.pixelOf(1000)));
    QMouseEvent move(QEvent::MouseMove, press(bar.pixelOf(1500)), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(&bar, &move);
    QTest::mouseRelease(&bar, Qt::LeftButton, {}, press(bar.pixelOf(1500)));
    QMouseEvent after(QEvent::MouseMove, press(100), Qt::NoButton, Qt::NoButton, {});
    QApplication::sendEvent(&bar, &after);
    ASSERT_EQ(asked.size(), 2u);
    EXPECT_NEAR(asked[0], 1000, 4);
    EXPECT_NEAR(asked[1], 1500, 4);
}

TEST_F(TimelineBarTest, MarksStandAtTheirTicks) {
    const Theme theme = Theme::light();
    for (const double zoom : {1.0, 6.0}) {
        show({{1200, TimelineMark::Kind::contact, 0, 1},
              {1300, TimelineMark::Kind::kick, 0, noBody},
              {1400, TimelineMark::Kind::fault, 0, noBody}});
        bar.zoom(zoom, bar.pixelOf(1300));
        for (const auto& [tick, kind] : {std::pair{1200, TimelineMark::Kind::contact},
                                         {1300, TimelineMark::Kind::kick},
                                         {1400, TimelineMark::Kind::fault}}) {
            const std::vector<int> columns = columnsOf(TimelineBar::colourOf(kind, theme));
            ASSERT_FALSE(columns.empty()) << tick;
            EXPECT_NEAR((columns.front() + columns.back()) / 2.0, bar.pixelOf(tick), 3) << tick;
            EXPECT_LE(columns.back() - columns.front(), 12) << tick;
        }
    }
}

TEST_F(TimelineBarTest, OfThousandsOfMarksInAnHourTheRareOnesAreSeen) {
    content.last = content.end = 180'000;
    std::vector<TimelineMark> marks;
    for (std::int64_t tick = 0; tick < content.last; tick += 4)
        marks.push_back({tick, TimelineMark::Kind::contact, 0, 1});
    marks.push_back({90'000, TimelineMark::Kind::goal, 0, 0});
    marks.push_back({90'300, TimelineMark::Kind::kick, 0, 0});
    std::stable_sort(marks.begin(), marks.end(), [](const auto& a, const auto& b) { return a.tick < b.tick; });
    show(marks);
    const std::vector<int> goal = columnsOf(TimelineBar::colourOf(TimelineMark::Kind::goal, Theme::light()), 30);
    ASSERT_FALSE(goal.empty());
    EXPECT_NEAR((goal.front() + goal.back()) / 2.0, bar.pixelOf(90'000), 3);
    const std::vector<int> contacts = columnsOf(TimelineBar::colourOf(TimelineMark::Kind::contact, Theme::light()));
    EXPECT_GT(contacts.size(), 900u);
    const QString told = bar.textAt(bar.pixelOf(90'000));
    EXPECT_TRUE(told.contains("30:00.00") && told.contains("tick 90000") && told.contains("goal") &&
                told.contains("kick"))
        << told.toStdString();
}

TEST_F(TimelineBarTest, GoesFromMarkToMark) {
    show({{100, TimelineMark::Kind::kick, 0, 0},
          {400, TimelineMark::Kind::contact, 0, 1},
          {500, TimelineMark::Kind::goal, 0, 0},
          {600, TimelineMark::Kind::contact, 0, 1},
          {900, TimelineMark::Kind::stop, 0, 0}});
    EXPECT_EQ(bar.nextMark(true), 600);
    EXPECT_EQ(bar.nextMark(false), 900);
    EXPECT_EQ(bar.previousMark(true), 400);
    EXPECT_EQ(bar.previousMark(false), 100);
    content.now = 50;
    show({{100, TimelineMark::Kind::kick, 0, 0}});
    EXPECT_EQ(bar.previousMark(true), std::nullopt);
}

TEST_F(TimelineBarTest, WheelZoomsAtTheCursorAndNowStaysInSight) {
    show();
    const auto wheel = [&](int delta, Qt::KeyboardModifiers keys) {
        const QPointF at(700, 30);
        QWheelEvent event(at, bar.mapToGlobal(at.toPoint()), {}, {0, delta}, Qt::NoButton, keys, Qt::NoScrollPhase,
                          false);
        QApplication::sendEvent(&bar, &event);
    };
    const std::int64_t before = bar.tickAt(700);
    wheel(1200, {});
    EXPECT_GT(bar.zoomed(), 4);
    EXPECT_EQ(bar.tickAt(700), before);
    wheel(-120, Qt::ShiftModifier);
    EXPECT_EQ(bar.tickAt(700 - 120), before);
    content.now = 10;
    show();
    EXPECT_GE(bar.pixelOf(10), 0);
    EXPECT_LE(bar.pixelOf(10), bar.width());
    const std::vector<int> handle = columnsOf(Theme::light().accent, 10);
    ASSERT_FALSE(handle.empty());
    EXPECT_GE(bar.pixelOf(10), handle.front() - 1);
    EXPECT_LE(bar.pixelOf(10), handle.back() + 1);
}

TEST_F(TimelineBarTest, NotedMarksAreReachedAmongTheRunsOwn) {
    content.noted = {{{700, TimelineMark::Kind::divergence, 0, 0}, "create 1, 12 cm"}};
    content.now = 500;
    show({{400, TimelineMark::Kind::kick, 0, 0},
          {650, TimelineMark::Kind::contact, 0, 1},
          {900, TimelineMark::Kind::goal, 0, 0}});
    EXPECT_EQ(bar.nextMark(true), 650);
    EXPECT_EQ(bar.nextMark(false), 700);
    EXPECT_EQ(bar.previousMark(false), 400);
    content.now = 800;
    bar.setContent(content);
    EXPECT_EQ(bar.previousMark(true), 700);
    EXPECT_EQ(bar.nextMark(true), 900);
    content.marks.reset();
    bar.setContent(content);
    EXPECT_EQ(bar.previousMark(true), 700);
    EXPECT_FALSE(bar.nextMark(true));
    const QString text = bar.textAt(bar.pixelOf(700));
    EXPECT_TRUE(text.contains("first divergence: create 1, 12 cm")) << text.toStdString();
    EXPECT_FALSE(bar.textAt(bar.pixelOf(700) + 20).contains("divergence"));
    const std::vector<int> columns = columnsOf(TimelineBar::colourOf(TimelineMark::Kind::divergence, Theme::light()));
    ASSERT_FALSE(columns.empty());
    EXPECT_NEAR(columns.front(), bar.pixelOf(700), 7);
    EXPECT_NEAR(columns.back(), bar.pixelOf(700), 7);
}

TEST_F(TimelineBarTest, StretchesWithoutTruthAreHatchedThere) {
    show();
    const QImage before = rendered(bar);
    content.unknown = {{1000, 1300}, {2500, std::numeric_limits<std::int64_t>::max()}};
    show();
    for (const QPoint& p : differences(before, rendered(bar))) {
        const bool first = p.x() >= bar.pixelOf(1000) - 1 && p.x() <= bar.pixelOf(1300) + 1;
        ASSERT_TRUE(first || p.x() >= bar.pixelOf(2500) - 1) << p.x();
    }
    EXPECT_GT(differences(before, rendered(bar)).size(), 200u);
    EXPECT_TRUE(bar.textAt(bar.pixelOf(1100)).contains("no ground truth"));
    EXPECT_FALSE(bar.textAt(bar.pixelOf(1400)).contains("no ground truth"));
}

}  // namespace
}  // namespace mrose
