// A log that is read again, and wishes that come while others are under way: nothing of what was before stays.
#include <QTimer>
#include <QToolButton>
#include <QTreeWidget>
#include <atomic>
#include <chrono>
#include <thread>

#include <gmock/gmock.h>

#include "files/window_files.h"
#include "gui/overlay_fixture.h"
#include "panels/plot_panel.h"
#include "scripting/window_script.h"
#include "widgets/timeline_bar.h"
#include "workflow/open_model.h"

namespace mrose::gui {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pointwise;

const RolloutPlan twoSeconds{RolloutPlan::Cut::every, 0, 2};

/// Everything farther apart than it was.
void stretch(Log& log) {
    for (Trajectory& trajectory : log.robots[0].trajectories)
        for (StampedPose& stamped : trajectory.poses) {
            stamped.pose.x *= 1.3;
            stamped.pose.y *= 1.3;
        }
}

void driveTwice(Log& log) {
    auto& trajectories = log.robots[0].trajectories;
    trajectories.push_back(trajectories.front());
    trajectories[0].name = "a";
    trajectories[1].name = "b";
}

class OverlayReloadTest : public OverlayTest {
protected:
    void reload() {
        window.files().reload("made.csv changed");
        settleAll();
    }
    std::string anyModel() const { return modelNames(*overlay.rollouts().log()).back(); }
};

TEST_F(OverlayReloadTest, ModelsMoveInTheWorldThatWasReadLast) {
    ASSERT_NO_FATAL_FAILURE(openLog(makeLog(), twoSeconds));
    overlay.models().add(anyModel());
    settleAll();
    ASSERT_EQ(overlay.models().all().size(), 2u);
    overlay.models().show(1, false);
    const PlayedLogPointer before = overlay.rollouts().log();
    makeLog(stretch);
    reload();
    EXPECT_NE(overlay.rollouts().log(), before);
    ASSERT_EQ(overlay.models().all().size(), 2u);
    EXPECT_EQ(&overlay.models().all()[1].world->log(), &overlay.rollouts().world().log());
    EXPECT_FALSE(overlay.models().all()[1].shown) << "as the user left it";
    overlay.models().show(1, true);
    overlay.shown().showNext(1);
    settleAll();
    ASSERT_EQ(reality().models.size(), 1u);
    EXPECT_EQ(reality().models[0].poses[0].front(), state().robots[0].pose);
}

TEST_F(OverlayReloadTest, RolloutThatIsGoneLeavesWhatWasReadBefore) {
    ASSERT_NO_FATAL_FAILURE(openLog(makeLog(driveTwice), twoSeconds));
    const std::size_t last = overlay.rollouts().requests().size() - 1;
    overlay.shown().show(last);
    settleAll();
    const PlayedLogPointer before = overlay.rollouts().log();
    makeLog([](Log& log) {
        driveTwice(log);
        log.robots[0].trajectories.pop_back();
    });
    reload();
    EXPECT_THAT(errors(), Contains(HasSubstr("has no rollout from")));
    EXPECT_EQ(overlay.rollouts().log(), before);
    EXPECT_EQ(overlay.rollouts().shown(), last);
    makeLog(driveTwice);
    reload();
    EXPECT_EQ(overlay.rollouts().log(), before);
    EXPECT_EQ(window.shown()->branches.size(), 1u) << "that is what was read";
    EXPECT_THAT(errors(), IsEmpty());
    makeLog([](Log& log) {
        driveTwice(log);
        stretch(log);
    });
    reload();
    EXPECT_NE(overlay.rollouts().log(), before);
    EXPECT_EQ(overlay.rollouts().shown(), last);
}

TEST_F(OverlayReloadTest, NothingStaysThatWasKnownOfTheOldLog) {
    ASSERT_NO_FATAL_FAILURE(openLog(makeLog(), twoSeconds));
    overlay.setBound({{0.0005, 0.005}, false});
    settleAll();
    ASSERT_TRUE(overlay.causes().finding());
    overlay.causes().show(0);
    makeLog(stretch);
    reload();
    EXPECT_FALSE(overlay.causes().shown());
    const Comparison alone = comparedAlone(overlay);
    for (const RolloutRow& row : overlay.rollouts().rows())
        EXPECT_EQ(row.position, knownMean(alone.rollouts[row.rollout]));
    EXPECT_EQ(reality().robots[0].trajectory, &overlay.rollouts().world().trajectory(0, 0));
    MainWindow other;
    ASSERT_TRUE(other.overlay().openNow({path("made.csv"), ""}, twoSeconds));
    other.overlay().setBound({{0.0005, 0.005}, false});
    other.overlay().settle();
    ASSERT_TRUE(other.overlay().causes().finding() && other.overlay().causes().finding()->diagnosis);
    ASSERT_TRUE(overlay.causes().finding() && overlay.causes().finding()->diagnosis);
    const Diagnosis &fresh = *other.overlay().causes().finding()->diagnosis,
                    &found = *overlay.causes().finding()->diagnosis;
    EXPECT_EQ(found.divergence.time, fresh.divergence.time);
    ASSERT_EQ(found.trials.size(), fresh.trials.size());
    EXPECT_EQ(found.trials.front().explained, fresh.trials.front().explained);
}

TEST_F(OverlayReloadTest, PlottedErrorsAreThoseOfTheNewRollout) {
    ASSERT_NO_FATAL_FAILURE(openLog(makeLog(), twoSeconds));
    const ValueKey key{positionErrorQuantity, overlay.rollouts().world().robots().front().name};
    const auto ahead = [&] {
        gui::settle(window.scripted());
        const std::vector<PlotCurve>& curves = window.plots().view().curves();
        const auto position =
            std::find_if(curves.begin(), curves.end(), [](const auto& curve) { return !curve.ghost; });
        std::vector<double> errors;
        for (const QPointF& point : position->ahead) errors.push_back(point.y() / 100);
        return errors;
    };
    const auto compared = [&] { return comparedAlone(overlay).rollouts.front().errors.position; };
    const std::vector<double> before = compared();
    EXPECT_THAT(ahead(), Pointwise(DoubleNear(1e-12), before));
    makeLog(stretch);
    reload();
    ASSERT_EQ(window.shown()->branch, 1u);
    EXPECT_NE(compared(), before);
    EXPECT_THAT(ahead(), Pointwise(DoubleNear(1e-12), compared()));
    // The branch before was not compared with the log as it is now.
    window.session().ask(&Debugger::undo);
    settleAll();
    ASSERT_EQ(window.shown()->branch, 0u);
    EXPECT_THAT(ahead(), IsEmpty());
    const auto told = [&] { return panel.causes().text().toStdString(); };
    EXPECT_THAT(told(), HasSubstr("not this branch"));
    window.session().ask(&Debugger::redo);
    settleAll();
    EXPECT_THAT(told(), Not(HasSubstr("not this branch")));
    EXPECT_THAT(ahead(), Pointwise(DoubleNear(1e-12), compared()));
    // Whoever has removed a curve does not get it back by that.
    window.plots().remove({headingErrorQuantity, key.body});
    makeLog();
    reload();
    gui::settle(window.scripted());
    EXPECT_THAT(window.plots().keys(), ElementsAre(key));
}

TEST_F(OverlayReloadTest, BreakOnDivergenceIsThatOfTheNewRollout) {
    ASSERT_NO_FATAL_FAILURE(openLog(makeLog(), twoSeconds));
    const DivergenceBound::At bound{0.02, 0.1};
    overlay.setBound({bound, false});
    seek(10);
    makeLog(stretch);
    reload();
    ASSERT_EQ(window.shown()->branch, 1u);
    seek(100);
    // The first instant from which on it is beyond for 0.3 s.
    const std::int64_t tenth = window.shown()->frame->scene().ticksOf(nanosecondsPerSecond / 10);
    std::int64_t expected = 0;
    for (std::int64_t tick = tenth, beyond = 0; tick <= 100 && expected == 0; tick += tenth) {
        seek(tick);
        const auto real = reality().robots[0].poseAt(window.shown()->frame->scene().timeOf(tick));
        ASSERT_TRUE(real);
        const PoseError error = poseError(*real, state().robots[0].pose);
        beyond = error.position > bound.position || error.heading > bound.heading ? beyond + 1 : 0;
        if (beyond == 4) expected = tick - 3 * tenth;
    }
    ASSERT_GT(expected, 10) << "a log stretched so far is left";
    Breakpoint leaves;
    leaves.text = "divergence";
    window.session().setBreakpoints({leaves});
    seek(10);
    QTest::keyClick(&window, Qt::Key_F6);
    settleAll();
    EXPECT_TRUE(window.shown()->atBreak);
    EXPECT_EQ(window.shown()->tick(), expected);
}

TEST_F(OverlayReloadTest, IsReadAgainThoughAnotherRolloutIsPickedMeanwhile) {
    ASSERT_NO_FATAL_FAILURE(openLog(makeLog(), twoSeconds));
    const PlayedLogPointer before = overlay.rollouts().log();
    makeLog(stretch);
    window.files().reload("made.csv changed");
    overlay.shown().showNext(1);
    settleAll();
    EXPECT_NE(overlay.rollouts().log(), before);
    EXPECT_EQ(overlay.rollouts().shown(), 1u);
}

TEST_F(OverlayReloadTest, ModelThatWasCancelledCanBeAddedAgain) {
    ASSERT_NO_FATAL_FAILURE(openLog(makeLog(), twoSeconds));
    overlay.models().add(anyModel());
    ASSERT_TRUE(overlay.work());
    EXPECT_TRUE(overlay.cancel());
    settleAll();
    EXPECT_FALSE(overlay.work());
    ASSERT_EQ(overlay.models().all().size(), 1u);
    overlay.models().add(anyModel());
    settleAll();
    EXPECT_EQ(overlay.models().all().size(), 2u);
}

TEST_F(OverlayReloadTest, JudgingAModelIsSeenAndCanBeEnded) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    overlay.models().add(anyModel());
    ASSERT_TRUE(waitFor([&] { return overlay.models().all().size() == 2 && overlay.work(); }));
    EXPECT_THAT(overlay.work()->what.toStdString(), HasSubstr(overlay.models().all()[1].name));
    EXPECT_TRUE(window.actions().perform("cancel", {}));
    EXPECT_FALSE(overlay.work());
    settleAll();
    ASSERT_TRUE(overlay.models().all()[1].figures.evaluated);
    EXPECT_FALSE(*overlay.models().all()[1].figures.evaluated);
    // As whatever else went wrong with it is said.
    const QTreeWidgetItem& item = *panel.models().topLevelItem(1);
    EXPECT_EQ(item.text(1), QString::fromUtf8("\u2013"));
    EXPECT_EQ(item.toolTip(1).toStdString(), overlay.models().all()[1].figures.compared->error().message());
    EXPECT_THAT(item.toolTip(1).toStdString(), HasSubstr("cancelled"));
    int asked = 0;
    const auto ended = evaluatedModel(*overlay.rollouts().log(), overlay.models().all()[0], 10 * nanosecondsPerSecond,
                                      [&](double) { return ++asked > 1; });
    EXPECT_FALSE(ended);
    EXPECT_EQ(asked, 1);
}

TEST_F(OverlayReloadTest, DiagnosisIsOfTheBoundAndTheRobotThatAreSet) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    overlay.setBound({{0.003, 0.02}, false});
    overlay.setBound({{0.01, 0.05}, false});
    int seen = 0, stale = 0;
    QObject::connect(&overlay, &Overlay::changed, &window, [&] {
        const RolloutRow* const row = overlay.rollouts().shownRow();
        if (!overlay.causes().finding() || !overlay.causes().finding()->diagnosis || row == nullptr || !row->divergence)
            return;
        ++seen;
        stale += overlay.causes().finding()->diagnosis->divergence.time != row->divergence->time;
    });
    settleAll();
    EXPECT_GT(seen, 0);
    EXPECT_EQ(stale, 0);
}

TEST_F(OverlayReloadTest, RolloutWithoutTruthSaysSo) {
    const std::string blind = makeLog([](Log& log) {
        auto& poses = log.robots[0].trajectories[0].poses;
        const Nanoseconds start = poses.front().time;
        std::erase_if(poses, [&](const StampedPose& stamped) {
            return stamped.time > start + fromSeconds(0.05) && stamped.time < start + fromSeconds(4.9);
        });
    });
    ASSERT_NO_FATAL_FAILURE(openLog(blind, twoSeconds));
    const RolloutRow* const row = overlay.rollouts().rowOf(0, 0);
    ASSERT_NE(row, nullptr);
    EXPECT_FALSE(row->position);
    EXPECT_FALSE(row->share);
    const std::string text = panel.causes().text().toStdString();
    EXPECT_THAT(text, HasSubstr("no ground truth here"));
    EXPECT_THAT(text, Not(HasSubstr("stays within")));
    const int line = panel.rollouts()->lineOf(0, 0);
    EXPECT_EQ(panel.rollouts()->index(line, RolloutList::error).data().toString(), QString::fromUtf8("\u2013"));
    EXPECT_EQ(panel.rollouts()->index(line, RolloutList::path).data().toString(), QString::fromUtf8("\u2013"));
}

TEST_F(OverlayReloadTest, PlanThatTheUserRefusesChangesNothing) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    window.session().branchOff({"mine"});
    settleAll();
    const std::size_t rollouts = overlay.rollouts().requests().size();
    int asked = 0;
    window.files().saver().setQuestion([&](const QString&) {
        ++asked;
        return RunSaver::Answer::cancel;
    });
    RolloutPlan plan = overlay.rollouts().plan();
    plan.length = 3;
    EXPECT_TRUE(overlay.setPlan(plan));
    settleAll();
    EXPECT_EQ(asked, 1);
    EXPECT_EQ(overlay.rollouts().plan(), RolloutPlan{});
    EXPECT_EQ(overlay.rollouts().requests().size(), rollouts);
    EXPECT_EQ(overlay.rollouts().shown(), 0u);
    EXPECT_NE(overlay.rollouts().comparison(), nullptr);
}

TEST_F(OverlayReloadTest, LogThatIsClosedWhileARolloutOpensLeavesNothingBehind) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), twoSeconds));
    const std::uint64_t before = window.shown()->run;
    overlay.shown().showNext(1);
    ASSERT_TRUE(waitFor([&] { return window.session().newestRun() != before; }));
    window.actions()["close_log"].trigger();
    settleAll();
    ASSERT_NE(window.shown()->run, before) << "the rollout was on its way";
    EXPECT_FALSE(window.shown()->frame->reality);
    EXPECT_FALSE(window.shown()->canDiverge);
}

TEST_F(OverlayReloadTest, NotesOnModelsGoWithThem) {
    for (const bool close : {false, true}) {
        ASSERT_NO_FATAL_FAILURE(openLog(makeLog()));
        overlay.models().add("create.net");
        settleAll();
        EXPECT_THAT(notes(), Contains(HasSubstr("another kind of robot")));
        if (close)
            overlay.close();
        else
            overlay.models().remove(1);
        EXPECT_THAT(notes(), Not(Contains(HasSubstr("another kind of robot"))));
    }
}

TEST_F(OverlayReloadTest, ComparisonThatWasCancelledIsBegunAgainByAButton) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), twoSeconds));
    const std::size_t all = overlay.rollouts().rows().size();
    auto* button = panel.findChild<QToolButton*>("compare_or_cancel");
    ASSERT_NE(button, nullptr);
    EXPECT_FALSE(button->isVisible());
    overlay.compareAll();
    EXPECT_TRUE(overlay.cancel());
    ASSERT_TRUE(button->isVisible());
    EXPECT_EQ(button->text(), "Compare");
    EXPECT_LT(overlay.rollouts().rows().size(), all);
    QTest::mouseClick(button, Qt::LeftButton);
    settleAll();
    EXPECT_EQ(overlay.rollouts().rows().size(), all);
    EXPECT_NE(overlay.rollouts().comparison(), nullptr);
    EXPECT_FALSE(button->isVisible());
}

TEST_F(OverlayReloadTest, ClosedLogLeavesNothingBehind) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    overlay.setBound({{0.02, 0.05}, false});
    clickLine(0);
    ASSERT_TRUE(overlay.rollouts().shownRow() != nullptr && overlay.rollouts().shownRow()->divergence);
    const std::int64_t tick = window.shown()->frame->scene().ticksOf(overlay.rollouts().shownRow()->divergence->time);
    ASSERT_TRUE(window.shown()->canDiverge);
    window.actions()["close_log"].trigger();
    settleAll();
    EXPECT_FALSE(window.shown()->frame->reality);
    EXPECT_FALSE(window.shown()->canDiverge);
    EXPECT_THAT(window.plots().view().levels(), IsEmpty());
    EXPECT_THAT(window.timeline().textAt(window.timeline().pixelOf(tick)).toStdString(), Not(HasSubstr("divergence")));
}

TEST_F(OverlayReloadTest, WindowGoesOnWhileTheSessionIsAtWork) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    std::atomic<bool> released = false, heard = false;
    window.session().doLongWork("work", [&](TimeTravel&, const Progress&) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (!released && std::chrono::steady_clock::now() < end) std::this_thread::yield();
        heard = released.load();
    });
    overlay.shown().show(1);
    QTimer::singleShot(1000, &window, [&] { released = true; });
    EXPECT_TRUE(waitFor([&] { return overlay.rollouts().shown() == 1u; }));
    EXPECT_TRUE(heard) << "the window's thread waited for the session";
}

TEST_F(OverlayReloadTest, WhereOneLooksAndWhatIsSelectedStay) {
    ASSERT_NO_FATAL_FAILURE(openLog(makeLog(), twoSeconds));
    window.field().setSelected(0);
    settleAll();
    window.field().viewport().zoom(2.5);
    window.field().viewport().pan({30, 20});
    const ViewTransform view = window.field().transform();
    makeLog(stretch);
    reload();
    EXPECT_TRUE(window.field().transform() == view);
    EXPECT_EQ(window.field().selected(), 0u);
}

}  // namespace
}  // namespace mrose::gui
