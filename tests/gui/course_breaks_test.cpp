#include <QLabel>
#include <QStatusBar>
#include <algorithm>

#include <gmock/gmock.h>

#include "files/window_files.h"
#include "gui/overlay_fixture.h"
#include "widgets/field_view.h"
#include "widgets/message_bar.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

/// Courses of 2 s of the shipped log, and breakpoints that look through all of them.
class CourseBreaksTest : public OverlayTest {
protected:
    void SetUp() override {
        OverlayTest::SetUp();
        ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {OverlayPlan::Cut::every, 0, 2}));
        ASSERT_GE(overlay.requests().size(), 8u);
    }

    void stopOn(const std::string& text) {
        Breakpoint breakpoint;
        breakpoint.text = text;
        window.session().setBreakpoints({breakpoint});
        settleAll();
    }
    void press(Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::keyClick(&window, Qt::Key_F6, modifiers);
        settleAll();
    }
    void open(std::size_t course) {
        ASSERT_TRUE(overlay.show(course));
        settleAll();
        ASSERT_EQ(overlay.shownCourse(), course);
    }
    std::string said() const {
        QString all;
        for (const QLabel* label : window.statusBar()->findChildren<QLabel*>()) all += label->text() + '\n';
        return all.toStdString();
    }
    std::size_t shownCourse() const { return overlay.shownCourse().value(); }

    /// By 1 m, at an instant: a branch.
    void moveAside(double seconds) {
        window.session().seek(ticksOf(seconds));
        settleAll();
        Pose aside = state().robots[0].pose;
        aside.y += 1;
        emit window.field().bodyMoved(0, aside);
        settleAll();
    }

    /// The simulated robot of a course as compare() has it, at its start and after each step.
    std::vector<Pose> posesOf(std::size_t course) const {
        for (const ComparedCourse& compared : overlay.comparison()->courses) {
            if (compared.request != course || compared.use == CourseUse::absent) continue;
            std::vector<Pose> poses{compared.real.truth.front()};
            poses.insert(poses.end(), compared.simulated.begin(), compared.simulated.end());
            return poses;
        }
        return {};
    }
    /// The first step within which its x comes to exceed a threshold; 0: none.
    std::size_t crossing(std::size_t course, double threshold) const {
        const std::vector<Pose> poses = posesOf(course);
        for (std::size_t k = 1; k < poses.size(); ++k)
            if (poses[k - 1].x <= threshold && poses[k].x > threshold) return k;
        return 0;
    }
    /// One that no course before `from` crosses, but one after it.
    double thresholdAfter(std::size_t from) const {
        double highest = -1e9;
        for (std::size_t course = 0; course < overlay.requests().size(); ++course) {
            double least = 1e9, most = -1e9;
            for (const Pose& pose : posesOf(course)) {
                least = std::min(least, pose.x);
                most = std::max(most, pose.x);
            }
            if (course >= from && most > highest + 0.1 && least < most - 0.05)
                return std::max(highest, least) / 2 + most / 2;
            highest = std::max(highest, most);
        }
        return highest + 1;
    }

    std::int64_t ticksOf(double seconds) const { return window.shown()->frame->scene().ticksOf(fromSeconds(seconds)); }
};

TEST_F(CourseBreaksTest, NextBreakIsFoundInACourseFurtherOnAndTheLastInOneBefore) {
    const double threshold = thresholdAfter(3);
    std::size_t expected = 1;
    while (expected < overlay.requests().size() && crossing(expected, threshold) == 0) ++expected;
    ASSERT_LT(expected, overlay.requests().size()) << "a log in which x grows later on";
    stopOn("robot[1].x > " + std::to_string(threshold));
    press();
    EXPECT_EQ(shownCourse(), expected);
    EXPECT_TRUE(window.shown()->atBreak);
    const auto step = static_cast<double>(crossing(expected, threshold));
    EXPECT_GT(window.shown()->tick(), ticksOf(0.1 * (step - 1)));
    EXPECT_LE(window.shown()->tick(), ticksOf(0.1 * step));
    const std::int64_t tick = window.shown()->tick();
    EXPECT_GT(state().robots[0].pose.x, threshold);

    // From further on, the last of them.
    std::size_t last = overlay.requests().size() - 1;
    while (std::ranges::none_of(posesOf(last - 1), [&](const Pose& pose) { return pose.x > threshold; })) --last;
    open(last);
    press(Qt::ShiftModifier);
    EXPECT_EQ(shownCourse(), last - 1);
    EXPECT_TRUE(window.shown()->atBreak);
    EXPECT_TRUE(last - 1 > expected || window.shown()->tick() >= tick);
    EXPECT_EQ(window.shown()->breakpoints.size(), 1u) << "they go along";
}

TEST_F(CourseBreaksTest, NoBreakAnywhereLeavesTheShownCourse) {
    stopOn("robot[1].x > 1000");
    open(2);
    press();
    EXPECT_EQ(shownCourse(), 2u);
    EXPECT_THAT(said(), HasSubstr("nor in those after it"));
    EXPECT_EQ(window.shown()->tick(), ticksOf(2)) << "the course's end";
    press();
    EXPECT_EQ(shownCourse(), 2u);
    EXPECT_EQ(window.shown()->tick(), ticksOf(2))
        << "what comes after the course's end is no part of the log's courses";
    press(Qt::ShiftModifier);
    EXPECT_EQ(shownCourse(), 2u);
    EXPECT_THAT(said(), HasSubstr("nor in those before it"));
    open(0);
    press(Qt::ShiftModifier);
    EXPECT_EQ(shownCourse(), 0u);
}

TEST_F(CourseBreaksTest, DivergencesOfAllCoursesAreGoneThroughInTheirOrder) {
    OverlayPlan plan{OverlayPlan::Cut::every, 0, 2};
    ASSERT_TRUE(overlay.setPlan(plan));
    overlay.setBound({{0.01, 0.5}, false});
    settleAll();
    std::vector<std::pair<std::size_t, std::int64_t>> expected, found;
    for (const OverlayRow& row : overlay.rows())
        if (row.divergence)
            expected.emplace_back(row.course, window.shown()->frame->scene().ticksOf(row.divergence->time));
    ASSERT_GE(expected.size(), 3u);
    stopOn("divergence");
    for (std::size_t i = 0; i <= expected.size(); ++i) {
        press();
        if (!window.shown()->atBreak) break;
        found.emplace_back(shownCourse(), window.shown()->tick());
    }
    EXPECT_EQ(found, expected);
    open(overlay.requests().size() - 1);
    QTest::keyClick(&window, Qt::Key_Home);
    settleAll();
    std::vector<std::pair<std::size_t, std::int64_t>> back;
    for (std::size_t i = 0; i <= expected.size(); ++i) {
        press(Qt::ShiftModifier);
        if (!window.shown()->atBreak) break;
        back.insert(back.begin(), {shownCourse(), window.shown()->tick()});
    }
    std::erase_if(expected, [&](const auto& one) { return one.first == overlay.requests().size() - 1; });
    EXPECT_EQ(back, expected);
}

TEST_F(CourseBreaksTest, BranchThatLeavesTheRealCourseStopsOnceThatIsHeld) {
    overlay.setBound({{0.3, 3}, false});
    settleAll();
    ASSERT_FALSE(overlay.shownRow()->divergence) << "the course itself stays";
    moveAside(0.94);
    ASSERT_EQ(window.shown()->branch, 1u);
    stopOn("divergence");
    press();
    EXPECT_TRUE(window.shown()->atBreak) << said();
    // Beyond at the first instant after, 1 s, and held for 0.3 s.
    EXPECT_EQ(window.shown()->tick(), ticksOf(1.3));
    window.session().seek(ticksOf(1.8));
    settleAll();
    press(Qt::ShiftModifier);
    EXPECT_EQ(window.shown()->tick(), ticksOf(1.3));
}

TEST_F(CourseBreaksTest, EscapeEndsTheSearch) {
    stopOn("robot[1].x > 1000");
    overlay.goToBreak({});
    window.session().settle();
    QApplication::processEvents();
    overlay.cancel();
    settleAll();
    EXPECT_EQ(shownCourse(), 0u);
    EXPECT_THAT(said(), testing::Not(HasSubstr("nor in those")));
    EXPECT_FALSE(window.messages().has("work"));
}

TEST_F(CourseBreaksTest, BranchThatIsNotSavedIsNotLeft) {
    moveAside(0.5);
    ASSERT_TRUE(window.files().hasUnsaved());
    stopOn("robot[1].x > 1000");
    press();
    EXPECT_THAT(said(), HasSubstr("not saved"));
    EXPECT_EQ(window.shown()->branch, 1u);
}

}  // namespace
}  // namespace mrose::gui
