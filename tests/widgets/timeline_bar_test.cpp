#include "widgets/timeline_bar.h"

#include <QApplication>
#include <QHelpEvent>
#include <QTest>
#include <QToolTip>
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
            const std::vector<int> columns = columnsOf(markColour(kind, theme));
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
    const std::vector<int> goal = columnsOf(markColour(TimelineMark::Kind::goal, Theme::light()), 40);
    ASSERT_FALSE(goal.empty());
    EXPECT_NEAR((goal.front() + goal.back()) / 2.0, bar.pixelOf(90'000), 3);
    const std::vector<int> contacts = columnsOf(markColour(TimelineMark::Kind::contact, Theme::light()));
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
    EXPECT_EQ(bar.content().nextMark(true), 600);
    EXPECT_EQ(bar.content().nextMark(false), 900);
    EXPECT_EQ(bar.content().previousMark(true), 400);
    EXPECT_EQ(bar.content().previousMark(false), 100);
    content.now = 50;
    show({{100, TimelineMark::Kind::kick, 0, 0}});
    EXPECT_EQ(bar.content().previousMark(true), std::nullopt);
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
    EXPECT_EQ(bar.content().nextMark(true), 650);
    EXPECT_EQ(bar.content().nextMark(false), 700);
    EXPECT_EQ(bar.content().previousMark(false), 400);
    content.now = 800;
    bar.setContent(content);
    EXPECT_EQ(bar.content().previousMark(true), 700);
    EXPECT_EQ(bar.content().nextMark(true), 900);
    content.marks.reset();
    bar.setContent(content);
    EXPECT_EQ(bar.content().previousMark(true), 700);
    EXPECT_FALSE(bar.content().nextMark(true));
    const QString text = bar.textAt(bar.pixelOf(700));
    EXPECT_TRUE(text.contains("first divergence: create 1, 12 cm")) << text.toStdString();
    EXPECT_FALSE(bar.textAt(bar.pixelOf(700) + 20).contains("divergence"));
    const std::vector<int> columns = columnsOf(markColour(TimelineMark::Kind::divergence, Theme::light()));
    ASSERT_FALSE(columns.empty());
    EXPECT_NEAR(columns.front(), bar.pixelOf(700), 7);
    EXPECT_NEAR(columns.back(), bar.pixelOf(700), 7);
}

TEST_F(TimelineBarTest, NotedMarksAreNamedWhereThereIsRoomAndThoseOfOthersAreFaint) {
    using Noted = TimelineBar::Content::Noted;
    const auto noted = [&](std::int64_t tick, const QString& name, bool faint) {
        return Noted{{tick, TimelineMark::Kind::divergence, 0, 0}, name + ", 12 cm", name, faint};
    };
    /// Whether names make a difference right of a tick.
    const auto named = [&](std::vector<Noted> marks, std::int64_t tick, int width = 60) {
        content.noted = marks;
        show();
        const QImage with = rendered(bar);
        for (Noted& mark : marks) mark.name.clear();
        content.noted = marks;
        show();
        int pixels = 0;
        for (const QPoint& p : differences(rendered(bar), with))
            pixels += p.x() > bar.pixelOf(tick) + 5 && p.x() < bar.pixelOf(tick) + width ? 1 : 0;
        return pixels > 20;
    };
    EXPECT_TRUE(named({noted(1000, "create 1", false)}, 1000));
    EXPECT_TRUE(named({noted(1000, "create 1", true)}, 1000));
    // Another mark stands where the name would.
    EXPECT_FALSE(named({noted(1000, "create 1", true), noted(1100, "create 2", false)}, 1000, 28));
    EXPECT_TRUE(named({noted(1000, "create 1", true), noted(1100, "create 2", false)}, 1100));
    const QColor colour = markColour(TimelineMark::Kind::divergence, Theme::light());
    content.noted = {noted(1000, "", true), noted(2000, "", false)};
    show();
    const std::vector<int> strong = columnsOf(colour);
    ASSERT_FALSE(strong.empty());
    EXPECT_NEAR(strong.front(), bar.pixelOf(2000), 7) << "the other one's is paler";
    EXPECT_NEAR(strong.back(), bar.pixelOf(2000), 7);
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

/// As in a soccer game of 91 s: a goal 0.96 s after the kick stands 7 pixels right of it, and both are seen.
TEST_F(TimelineBarTest, AGoalSoonAfterAKickHidesItNot) {
    bar.resize(680, bar.sizeHint().height());
    content.last = content.end = 4550;
    show({{793, TimelineMark::Kind::kick, 0, noBody}, {841, TimelineMark::Kind::goal, 0, 0}});
    for (const auto& [tick, kind] : {std::pair{793, TimelineMark::Kind::kick}, {841, TimelineMark::Kind::goal}}) {
        const std::vector<int> columns = columnsOf(markColour(kind, Theme::light()));
        ASSERT_FALSE(columns.empty());
        EXPECT_NEAR((columns.front() + columns.back()) / 2.0, bar.pixelOf(tick), 3) << tick;
    }
    EXPECT_TRUE(bar.textAt(bar.pixelOf(841)).contains("goal"));
    EXPECT_FALSE(bar.textAt(bar.pixelOf(841)).contains("kick"));
}

TEST_F(TimelineBarTest, MarksOfAKindThatLieTooNearStandAtTheFirstWithTheirNumber) {
    const std::vector<TimelineMark> marks{
        {100, TimelineMark::Kind::kick, 0, 0}, {102, TimelineMark::Kind::kick, 0, 0},
        {103, TimelineMark::Kind::goal, 0, 0}, {105, TimelineMark::Kind::contact, 0, 1},
        {106, TimelineMark::Kind::kick, 0, 0}, {120, TimelineMark::Kind::kick, 0, 0}};
    const auto signs = signsOf(
        marks, [](std::int64_t tick) { return 2.0 * static_cast<double>(tick); },
        [](int count) { return count < 2 ? 9.0 : 15.0; });
    ASSERT_EQ(signs.size(), 3u);
    EXPECT_EQ(signs[0].kind, TimelineMark::Kind::kick);
    EXPECT_EQ(signs[0].x, 200);
    EXPECT_EQ(signs[0].count, 3);
    EXPECT_EQ(signs[0].last, 106);
    EXPECT_EQ(signs[1].kind, TimelineMark::Kind::goal);
    EXPECT_EQ(signs[1].x, 206);
    EXPECT_EQ(signs[2].x, 240);
    EXPECT_EQ(signs[2].count, 1);
}

/// What one sign stands for is told where it stands, and nothing lies under another kind.
TEST_F(TimelineBarTest, AfterThreeQuartersOfAnHourKicksAreStillSeenAndContactsTellWhereTheyAreMany) {
    content.last = content.end = 135'000;
    std::vector<TimelineMark> marks;
    for (std::int64_t tick = 0; tick < content.last; tick += tick < 60'000 ? 60 : 400)
        marks.push_back({tick, TimelineMark::Kind::contact, 0, 1});
    for (std::int64_t tick = 300; tick < content.last; tick += 550) {
        marks.push_back({tick, TimelineMark::Kind::kick, 0, 0});
        marks.push_back({tick + 10, TimelineMark::Kind::goal, 0, 0});
    }
    std::stable_sort(marks.begin(), marks.end(), [](const auto& a, const auto& b) { return a.tick < b.tick; });
    show(marks);
    for (const TimelineMark::Kind kind : {TimelineMark::Kind::kick, TimelineMark::Kind::goal})
        EXPECT_GT(columnsOf(markColour(kind, Theme::light())).size(), 150u);
    const QString text = bar.textAt(bar.pixelOf(300));
    EXPECT_TRUE(text.contains(QString::fromUtf8("kick \u00d7 ")) && text.contains("at 6.00 s") &&
                text.contains("at 17.00 s"))
        << text.toStdString();
    const QImage image = rendered(bar);
    const QColor touched = markColour(TimelineMark::Kind::contact, Theme::light());
    const auto highest = [&](std::int64_t tick) {
        int most = 0;
        for (int x = static_cast<int>(bar.pixelOf(tick)); x < bar.pixelOf(tick) + 30; ++x) {
            int high = 0;
            for (int y = 0; y < image.height(); ++y) high += image.pixelColor(x, y) == touched ? 1 : 0;
            most = std::max(most, high);
        }
        return most;
    };
    EXPECT_GT(highest(20'000), highest(100'000));
}

TEST_F(TimelineBarTest, AClickGoesToTheMarkBesideItAndADragDoesNot) {
    content.branches = {1000};
    content.noted = {{{1600, TimelineMark::Kind::divergence, 0, 0}, "create 1, 12 cm"}};
    show({{700, TimelineMark::Kind::kick, 0, 0},
          {703, TimelineMark::Kind::goal, 0, 0},
          {1300, TimelineMark::Kind::hit, 1, 0}});
    std::vector<std::int64_t> asked;
    QObject::connect(&bar, &TimelineBar::tickRequested, [&](std::int64_t tick) { asked.push_back(tick); });
    const auto click = [&](double x, double y) {
        asked.clear();
        const QPoint at(static_cast<int>(std::lround(x)), static_cast<int>(y));
        QTest::mouseClick(&bar, Qt::LeftButton, {}, at);
        return asked;
    };
    for (const std::int64_t tick : {1000, 1300, 1600})
        for (const double off : {-3.0, 0.0, 3.0})
            EXPECT_EQ(click(bar.pixelOf(tick) + off, timeline::trackTop + 5), (std::vector<std::int64_t>{tick})) << off;
    EXPECT_EQ(click(bar.pixelOf(703), timeline::goalLane), (std::vector<std::int64_t>{703}));
    EXPECT_EQ(click(bar.pixelOf(703), timeline::kickLane), (std::vector<std::int64_t>{700})) << "in its lane";
    const std::vector<std::int64_t> beside = click(bar.pixelOf(1000) + 8, timeline::trackTop + 5);
    ASSERT_EQ(beside.size(), 1u);
    EXPECT_EQ(beside[0], bar.tickAt(std::lround(bar.pixelOf(1000) + 8)));
    const QPoint from(static_cast<int>(bar.pixelOf(900)), 50), to(static_cast<int>(bar.pixelOf(1000)) + 2, 50);
    asked.clear();
    QTest::mousePress(&bar, Qt::LeftButton, {}, from);
    QMouseEvent move(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(&bar, &move);
    QTest::mouseRelease(&bar, Qt::LeftButton, {}, to);
    EXPECT_EQ(asked.back(), bar.tickAt(to.x()));
}

TEST_F(TimelineBarTest, ToolTipStandsAboveTheBarAndOnTheScreen) {
    show({{700, TimelineMark::Kind::kick, 0, 0}, {703, TimelineMark::Kind::goal, 0, 0}});
    for (const int top : {0, 300}) {
        bar.move(20, top);
        bar.show();
        const QPoint at(static_cast<int>(bar.pixelOf(700)), 50);
        QHelpEvent event(QEvent::ToolTip, at, bar.mapToGlobal(at));
        QApplication::sendEvent(&bar, &event);
        const QWidget* tip = nullptr;
        for (const QWidget* one : QApplication::topLevelWidgets())
            if (one->inherits("QTipLabel") && one->isVisible()) tip = one;
        ASSERT_NE(tip, nullptr);
        EXPECT_GE(tip->geometry().top(), 0);
        if (top > 0) {
            EXPECT_LT(tip->geometry().bottom(), bar.mapToGlobal(QPoint(0, 0)).y());
        }
        QToolTip::hideText();
        QApplication::processEvents();
    }
}

TEST_F(TimelineBarTest, NumbersOfAnHourStandClearOfAllSigns) {
    content.last = content.end = 180'000;
    std::vector<TimelineMark> marks;
    for (std::int64_t tick = 0; tick < content.last; tick += 90)
        marks.push_back({tick, static_cast<TimelineMark::Kind>(1 + (tick / 90) % 5), 0, 0});
    const auto xOf = [](std::int64_t tick) { return 0.0055 * static_cast<double>(tick); };
    const auto widthOf = [](int count) { return count < 2 ? 9.0 : 16.0 + 6.0 * (count > 9 ? 2 : 1); };
    const std::vector<TimelineSign> signs = signsOf(marks, xOf, widthOf);
    int numbered = 0, bare = 0;
    for (const TimelineSign& sign : signs) {
        numbered += sign.numbered ? 1 : 0;
        bare += sign.count > 1 && !sign.numbered ? 1 : 0;
        for (const TimelineSign& other : signs) {
            if (!sign.numbered || &other == &sign || timeline::laneOf(other.kind) != timeline::laneOf(sign.kind))
                continue;
            const double end = sign.x + sign.width - timeline::leastSignGap;  // of the number
            EXPECT_TRUE(other.x + 4.5 <= sign.x + 5 || other.x - 4.5 >= end) << sign.x << ' ' << other.x;
        }
    }
    EXPECT_GT(numbered, 20);
    EXPECT_GT(bare, 20) << "those of a lane that several kinds share";
}

TEST_F(TimelineBarTest, PagesGoByATenthOfWhatIsSeen) {
    show();
    EXPECT_TRUE(bar.focusPolicy() & Qt::TabFocus);
    std::vector<std::int64_t> asked;
    QObject::connect(&bar, &TimelineBar::tickRequested, [&](std::int64_t tick) { asked.push_back(tick); });
    QTest::keyClick(&bar, Qt::Key_PageDown);
    QTest::keyClick(&bar, Qt::Key_PageUp);
    bar.zoom(3);
    QTest::keyClick(&bar, Qt::Key_PageDown);
    content.now = 100;
    show();
    bar.zoom(1e-9);
    QTest::keyClick(&bar, Qt::Key_PageUp);
    EXPECT_EQ(asked, (std::vector<std::int64_t>{800, 200, 600, 0}));
}

}  // namespace
}  // namespace mrose
