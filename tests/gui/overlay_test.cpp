// A real log laid over its simulation: opened, its rollouts chosen, its figures those of `mrose compare` and
// `evaluate`.
#include "reality/overlay.h"

#include <QDockWidget>
#include <QLabel>
#include <QTreeView>
#include <QTreeWidget>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <gmock/gmock.h>

#include "assessment/evaluate.h"
#include "files/window_files.h"
#include "gui/overlay_fixture.h"
#include "logs/log_reader.h"
#include "motion/learned_model.h"
#include "panels/plot_panel.h"
#include "panels/time_bar.h"
#include "reality/overlay_panel.h"
#include "recording/recording.h"
#include "scripting/window_script.h"
#include "support/places.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "widgets/rollout_strip.h"
#include "workflow/open_model.h"
#include "workflow/resources.h"

namespace mrose::gui {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(OverlayTest, DroppedLogIsShownAtItsFirstRolloutWithAllOthersInTheList) {
    dropFile(shipped());
    QApplication::processEvents();
    settleAll();
    ASSERT_TRUE(overlay.rollouts().log());
    ASSERT_NE(window.shown(), nullptr);
    EXPECT_EQ(overlay.rollouts().shown(), 0u);
    EXPECT_TRUE(window.findChild<QDockWidget*>("reality")->isVisible());
    EXPECT_TRUE(window.rolloutStrip().isVisible());
    ASSERT_TRUE(window.shown()->frame->reality);
    const auto real = reality().robots[0].poseAt(0);
    ASSERT_TRUE(real);
    const Pose& simulated = window.shown()->frame->state.robots[0].pose;
    EXPECT_LT(std::hypot(real->x - simulated.x, real->y - simulated.y), 0.02) << "it begins where the real one was";
    EXPECT_EQ(panel.list().model()->rowCount(), static_cast<int>(overlay.rollouts().rows().size()));
    EXPECT_THAT(notes(), Contains(HasSubstr("simulated robot")));
    EXPECT_THAT(errors(), IsEmpty());
}

TEST_F(OverlayTest, FiguresAreThoseOfCompareToTheLastBit) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    const Comparison alone = comparedAlone(overlay);
    EXPECT_EQ(overlay.rollouts().comparison()->all.counted.p, alone.all.counted.p);
    EXPECT_EQ(overlay.rollouts().comparison()->all.counted.hd, alone.all.counted.hd);
    std::size_t simulated = 0;
    for (const ComparedRollout& rollout : alone.rollouts) {
        if (rollout.use == RolloutUse::absent) continue;
        ++simulated;
        const RolloutRow* const row = overlay.rollouts().rowOf(rollout.request, rollout.robot);
        ASSERT_NE(row, nullptr);
        EXPECT_EQ(row->position, knownMean(rollout));
        if (rollout.use == RolloutUse::counted) {
            EXPECT_EQ(row->heading, rollout.errors.headingMean);
        }
    }
    EXPECT_EQ(overlay.rollouts().rows().size(), simulated);
    const std::vector<std::size_t> order = worstFirst(alone);
    for (int line = 0; line < panel.rollouts()->rowCount(); ++line) {
        const ComparedRollout& rollout = alone.rollouts[order[static_cast<std::size_t>(line)]];
        EXPECT_EQ(panel.rollouts()->row(line).position, knownMean(rollout)) << "line " << line;
    }
}

TEST_F(OverlayTest, RunOfARolloutIsTheOneThatWasCompared) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    clickLine(0);
    const RolloutRow& worst = panel.rollouts()->row(0);
    EXPECT_EQ(overlay.rollouts().shown(), worst.rollout);
    const Comparison alone = comparedAlone(overlay);
    const auto rollout = std::find_if(alone.rollouts.begin(), alone.rollouts.end(), [&](const ComparedRollout& c) {
        return c.request == worst.rollout && c.robot == worst.robot;
    });
    const Scene& scene = window.shown()->frame->scene();
    for (const std::size_t k : {9u, 49u, 99u}) {
        seek(scene.ticksOf(static_cast<Nanoseconds>(k + 1) * WindowOptions{}.step));
        EXPECT_EQ(state().robots[0].pose, rollout->simulated[k]);
        const auto real = reality().robots[0].poseAt(scene.timeOf(state().tick));
        ASSERT_TRUE(real);
        EXPECT_EQ(poseError(*real, state().robots[0].pose).position, rollout->errors.position[k]);
    }
}

TEST_F(OverlayTest, KeyGoesToWhereItLeavesTheRealTrajectory) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    overlay.setBound({{0.02, 0.05}, false});
    settleAll();
    clickLine(0);
    const RolloutRow* const row = overlay.rollouts().shownRow();
    ASSERT_NE(row, nullptr);
    ASSERT_TRUE(row->divergence);
    window.field().setFocus();
    QTest::keyClick(&window, Qt::Key_D);
    window.session().settle();
    const Scene& scene = window.shown()->frame->scene();
    EXPECT_EQ(scene.timeOf(state().tick), row->divergence->time);
    const auto real = reality().robots[0].poseAt(row->divergence->time);
    const PoseError error = poseError(*real, state().robots[0].pose);
    EXPECT_TRUE(error.position > 0.02 || error.heading > 0.05);
    EXPECT_EQ(error.position, row->divergence->position);
    ASSERT_TRUE(overlay.causes().finding());
    ASSERT_TRUE(overlay.causes().finding()->diagnosis) << overlay.causes().finding()->error.toStdString();
    EXPECT_EQ(panel.causes().causes().topLevelItemCount(),
              static_cast<int>(overlay.causes().finding()->diagnosis->trials.size()));
    EXPECT_THAT(panel.causes().text().toStdString(), HasSubstr("explains"));
}

TEST_F(OverlayTest, DivergenceIsMarkedOnTheTimelineAndInThePlots) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    overlay.setBound({{0.02, 0.05}, false});
    settleAll();
    clickLine(0);
    const RolloutRow* const row = overlay.rollouts().shownRow();
    ASSERT_TRUE(row != nullptr && row->divergence);
    const std::int64_t tick = window.shown()->frame->scene().ticksOf(row->divergence->time);
    const QString said = window.timeline().textAt(window.timeline().pixelOf(tick));
    const QString name = qtText(window.shown()->frame->nameOf(0));
    EXPECT_THAT(said.toStdString(), HasSubstr(("first divergence: " + name).toStdString()));
    window.session().seek(tick + 5);
    settleAll();
    window.field().setFocus();
    QTest::keyClick(&window, Qt::Key_Comma, Qt::ControlModifier);
    settleAll();
    EXPECT_EQ(state().tick, tick);
    const std::vector<PlotLevel>& levels = window.plots().view().levels();
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_NEAR(levels[0].points.front().y(), 2, 1e-12);
    EXPECT_NEAR(levels[1].points.front().y(), 0.05 * 180 / std::numbers::pi, 1e-12);
    overlay.setBound({{9, 3}, false});
    settleAll();
    EXPECT_THAT(window.timeline().textAt(window.timeline().pixelOf(tick)).toStdString(),
                testing::Not(HasSubstr("divergence")));
    ASSERT_TRUE(window.open("soccer.toml"));
    settleAll();
    EXPECT_THAT(window.plots().view().levels(), IsEmpty());
}

TEST_F(OverlayTest, CauseThatIsClickedIsLaidBeside) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    overlay.setBound({{0.02, 0.05}, false});
    settleAll();
    clickLine(0);
    ASSERT_TRUE(overlay.causes().finding() && overlay.causes().finding()->diagnosis);
    EXPECT_THAT(reality().models, IsEmpty());
    QTreeWidget& causes = panel.causes().causes();
    QTest::mouseClick(causes.viewport(), Qt::LeftButton, {}, causes.visualItemRect(causes.topLevelItem(0)).center());
    settleAll();
    ASSERT_EQ(reality().models.size(), 1u);
    EXPECT_EQ(reality().models[0].name, overlay.causes().finding()->diagnosis->trials[0].what);
    ASSERT_FALSE(reality().models[0].poses[0].empty());
    EXPECT_EQ(reality().models[0].poses[0].front(), window.shown()->frame->state.robots[0].pose);
}

TEST_F(OverlayTest, WindowsAreThoseOfEvaluateWithItsFigures) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::windows, 0, 10}));
    const auto log = readLog(shipped());
    ASSERT_TRUE(log);
    auto network = loadNetwork(sourceFolder() / "nets" / "pioneer.net");
    ASSERT_TRUE(network);
    const LearnedModel model(std::make_shared<const LearnedMotion>(std::move(*network)), "reference");
    const NamedModel named = NamedModel::same("network", model);
    const auto evaluation = evaluate(*log, {&named, 1});
    ASSERT_TRUE(evaluation);
    ASSERT_EQ(overlay.rollouts().requests().size(), evaluation->log.windows.size());
    EXPECT_EQ(overlay.rollouts().rows().size(), evaluation->log.windows.size());
    ASSERT_TRUE(overlay.models().all().front().figures.evaluated);
    EXPECT_EQ((*overlay.models().all().front().figures.evaluated)->p, evaluation->models[0].all.p);
    EXPECT_EQ((*overlay.models().all().front().figures.evaluated)->hd, evaluation->models[0].all.hd);
}

TEST_F(OverlayTest, SecondModelDrivesTheSameCommandsBeside) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    ASSERT_FALSE(modelNames(*overlay.rollouts().log()).empty());
    const auto simple = modelNames(*overlay.rollouts().log()).back();
    ASSERT_TRUE(window.actions().perform("add_model", qtText(simple)));
    settleAll();
    ASSERT_EQ(overlay.models().all().size(), 2u);
    const JudgedModel& model = overlay.models().all()[1];
    ASSERT_TRUE(model.figures.compared && *model.figures.compared);
    ComparisonOptions options;
    options.seed = overlay.rollouts().log()->seed;
    const auto alone = compare(*model.world, overlay.rollouts().requests(), options);
    ASSERT_TRUE(alone);
    EXPECT_EQ((*model.figures.compared)->counted.p, alone->all.counted.p);
    EXPECT_NE((*model.figures.compared)->counted.p, overlay.rollouts().comparison()->all.counted.p);
    ASSERT_EQ(reality().models.size(), 1u);
    const auto& first = alone->rollouts.front();
    for (const std::size_t k : {0u, 99u}) {
        const auto pose = reality().models[0].poseAt(0, static_cast<Nanoseconds>(k + 1) * WindowOptions{}.step);
        ASSERT_TRUE(pose);
        EXPECT_EQ(*pose, first.simulated[k]);
    }
    panel.models().topLevelItem(1)->setCheckState(0, Qt::Unchecked);
    settleAll();
    EXPECT_THAT(reality().models, IsEmpty());
}

TEST_F(OverlayTest, PlayingGoesOnIntoTheNextRollout) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    window.timeBar().setSpeed(0);
    window.session().play();
    EXPECT_TRUE(waitFor([&] { return overlay.rollouts().shown() >= 2u; }));
    overlay.setRestarts(false);
    window.session().pause();
    settleAll();
    EXPECT_GE(reality().start, 4 * nanosecondsPerSecond);
    EXPECT_EQ(reality().start, overlay.rollouts().requests()[*overlay.rollouts().shown()].start);
}

TEST_F(OverlayTest, BranchThatIsNotSavedHoldsTheNextRolloutBack) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    seek(10);
    window.session().branchOff({"mine"});
    settleAll();
    bool asked = false;
    window.files().saver().setQuestion([&](const QString&) {
        asked = true;
        return RunSaver::Answer::cancel;
    });
    clickLine(1);
    EXPECT_TRUE(asked);
    EXPECT_EQ(overlay.rollouts().shown(), 0u);
}

TEST_F(OverlayTest, ClickOnTheStripOpensTheRolloutThere) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    RolloutStrip& strip = window.rolloutStrip();
    QTest::mouseClick(&strip, Qt::LeftButton, {}, QPoint(static_cast<int>(strip.pixelOf(3)), strip.height() / 2));
    settleAll();
    EXPECT_EQ(overlay.rollouts().shown(), 3u);
    EXPECT_EQ(reality().start, overlay.rollouts().requests()[3].start);
    const QString told = strip.textAt(strip.pixelOf(3));
    EXPECT_THAT(told.toStdString(), HasSubstr("off on average"));
}

TEST_F(OverlayTest, RecordedRolloutReopensExactlyAndFindsItsLog) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    clickLine(0);
    const Nanoseconds start = reality().start;
    seek(100);
    const StateHash hash = window.shown()->hash;
    ASSERT_TRUE(window.files().saver().saveRecording(qPath("course.mcap")));
    settleAll();
    MainWindow other;
    other.QWidget::show();
    ASSERT_TRUE(other.open(qPath("course.mcap")));
    other.session().seek(100);
    other.session().settle();
    EXPECT_EQ(other.shown()->hash, hash);
    other.overlay().settle();
    other.session().settle();
    ASSERT_TRUE(other.shown()->frame->reality);
    EXPECT_EQ(other.shown()->frame->reality->robots[0].origin, reality().robots[0].origin) << "from " << start;
}

TEST_F(OverlayTest, SavedStateOfARolloutGoesOnAsTheRollout) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    seek(120);
    ASSERT_TRUE(window.files().saver().saveScenario(qPath("state.toml")));
    settleAll();
    EXPECT_THAT(errors(), IsEmpty());
    EXPECT_TRUE(std::filesystem::exists(path("state.toml")));
}

TEST_F(OverlayTest, CancelledComparisonKeepsWhatIsDone) {
    const auto opened = overlay.openNow({shipped(), ""}, RolloutPlan{RolloutPlan::Cut::every, 0, 0.5});
    ASSERT_TRUE(opened) << opened.error().message();
    std::vector<std::size_t> done;
    const auto cancel = QObject::connect(&overlay, &Overlay::changed, &window, [&] {
        if (overlay.rollouts().rows().empty() || !done.empty()) return;
        for (const RolloutRow& row : overlay.rollouts().rows()) done.push_back(row.rollout);
        EXPECT_TRUE(window.actions().perform("cancel", {}));
    });
    ASSERT_TRUE(waitFor([&] { return !done.empty(); }));
    QObject::disconnect(cancel);
    settleAll();
    EXPECT_EQ(overlay.comparing().share(), 1);
    EXPECT_EQ(overlay.rollouts().comparison(), nullptr);
    std::vector<std::size_t> kept;
    for (const RolloutRow& row : overlay.rollouts().rows()) kept.push_back(row.rollout);
    EXPECT_EQ(kept, done);
    EXPECT_LT(kept.size(), overlay.rollouts().requests().size());
    EXPECT_THAT(overlay.comparing().error().toStdString(), HasSubstr("Cancelled"));
}

TEST_F(OverlayTest, EachWrongLogIsAnsweredByOneLineThatSaysWhatToDo) {
    EXPECT_THAT(refusal({path("nowhere.csv"), ""}), HasSubstr("does not exist"));
    const std::string noTruth = makeLog([](Log& log) {
        for (Trajectory& trajectory : log.robots[0].trajectories) trajectory.poses.clear();
    });
    EXPECT_THAT(refusal({noTruth, ""}), HasSubstr("no ground truth"));
    write("foreign.csv", "t,v_cmd,w_cmd,x,y,heading\n0,0.1,0,1,2,0\n0.1,0.1,0,1.01,2,0\n0.2,0.1,0,1.02,2,0\n");
    EXPECT_THAT(refusal({path("foreign.csv"), ""}), HasSubstr("--robot"));
    EXPECT_THAT(refusal({path("foreign.csv"), "mrclam_replay.toml"}), HasSubstr("has no robot"));
    EXPECT_THAT(refusal({shipped(), "soccer.toml"}), HasSubstr("plays no log"));
    write("half.csv", "t,v_cmd,w_cmd,x,y,heading\n0,0.1,0,1,2");
    EXPECT_THAT(refusal({path("half.csv"), ""}), HasSubstr("half.csv"));
    RolloutPlan late;
    late.start = 5000;
    EXPECT_THAT(refusal({shipped(), ""}, late), HasSubstr("earlier start"));
    EXPECT_FALSE(overlay.rollouts().log());
    for (const std::string& error : errors()) EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST_F(OverlayTest, GapInTheTruthIsSaidAndTheRestGoesOn) {
    const std::string gap = makeLog([](Log& log) {
        std::erase_if(log.robots[0].trajectories[0].poses, [](const StampedPose& stamped) {
            return stamped.time > 5 * nanosecondsPerSecond && stamped.time < 7 * nanosecondsPerSecond;
        });
    });
    ASSERT_NO_FATAL_FAILURE(openLog(gap, {RolloutPlan::Cut::every, 0, 4}));
    EXPECT_THAT(overlay.rollouts().rows(), Contains(testing::Field(&RolloutRow::use, RolloutUse::gap)));
    EXPECT_THAT(overlay.rollouts().rows(), Contains(testing::Field(&RolloutRow::use, RolloutUse::counted)));
    const auto& rollout =
        *std::find_if(overlay.rollouts().rows().begin(), overlay.rollouts().rows().end(),
                      [](const RolloutRow& row) { return row.use == RolloutUse::gap && row.position; });
    overlay.shown().show(rollout.rollout, rollout.robot);
    settleAll();
    EXPECT_THAT(panel.causes().text().toStdString(), HasSubstr("where the ground truth is known"));
    EXPECT_EQ(panel.rollouts()
                  ->index(panel.rollouts()->lineOf(rollout.rollout, rollout.robot), RolloutList::drives)
                  .data()
                  .toString(),
              "gap in truth");
    const auto counted = std::count_if(overlay.rollouts().rows().begin(), overlay.rollouts().rows().end(),
                                       [](const RolloutRow& row) { return row.use == RolloutUse::counted; });
    QString labels;
    for (const QLabel* label : panel.findChildren<QLabel*>()) labels += label->text() + '\n';
    EXPECT_THAT(labels.toStdString(), HasSubstr(std::to_string(counted) + " of " +
                                                std::to_string(overlay.rollouts().rows().size()) + " count: "));
}

TEST_F(OverlayTest, ScriptsAskForFiguresAndOpenTheWorst) {
    const std::string script = "open_log('" + shipped() + "')\n" +
                               "worst(1)\n"
                               "expect(reality('p') > 0 and reality('rollouts') > 10)\n"
                               "expect(reality('error') > 0, 'an error')\n"
                               "say(reality('robot'))\n"
                               "reality('nonsense')\n";
    std::vector<std::string> words;
    const auto done = runScript(window.scripted(), script, "s.lua",
                                {[&](const std::string& said) { words.push_back(said); },
                                 [&](const std::string& mistake) { ADD_FAILURE() << mistake; }});
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message(), HasSubstr("expected one of"));
    EXPECT_THAT(words, testing::ElementsAre("pioneer reference"));
}

TEST_F(OverlayTest, SeekingEndsWhereTheRolloutDoes) {
    ASSERT_TRUE(runScript(window.scripted(), "open_log('" + shipped() + "')\nseek(3600)\n", "s.lua",
                          {[](const std::string&) {}, [](const std::string& mistake) { ADD_FAILURE() << mistake; }}));
    settleAll();
    const auto end = overlay.shown().endTick();
    ASSERT_TRUE(end);
    EXPECT_EQ(window.session().current()->tick(), *end);
}

/// The real logs, where they are.
class MrclamOverlayTest : public OverlayTest {
protected:
    void SetUp() override {
        const char* const data = std::getenv("MROSE_DATA");
        if (data == nullptr || *data == '\0') GTEST_SKIP() << "MROSE_DATA is not set";
        if (!looksLikeLog(placeOfLog("MRCLAM_Dataset6"))) GTEST_SKIP() << "no MRCLAM data set 6";
    }
};

TEST_F(MrclamOverlayTest, WorstWindowLeavesTheRealTrajectoryForAReason) {
    ASSERT_NO_FATAL_FAILURE(openLog(placeOfLog("MRCLAM_Dataset6"), {RolloutPlan::Cut::every, 0, 10}));
    EXPECT_EQ(overlay.rollouts().world().robots().size(), 5u);
    const Comparison alone = comparedAlone(overlay);
    EXPECT_EQ(overlay.rollouts().comparison()->all.counted.p, alone.all.counted.p);
    overlay.setBound({{0.03, 0.1}, false});
    clickLine(0);
    ASSERT_TRUE(overlay.rollouts().shownRow());
    EXPECT_EQ(overlay.rollouts().shownRow()->position, knownMean(alone.rollouts[worstFirst(alone).front()]));
    ASSERT_TRUE(overlay.rollouts().shownRow()->divergence);
    ASSERT_TRUE(overlay.causes().finding() && overlay.causes().finding()->diagnosis);
    EXPECT_TRUE(overlay.shown().goToDivergence());
    settleAll();
    EXPECT_EQ(window.shown()->frame->scene().timeOf(state().tick), overlay.rollouts().shownRow()->divergence->time);
}

TEST_F(MrclamOverlayTest, ScenarioThatPlaysItGetsItsOverlayToo) {
    open("mrclam_replay.toml");
    settleAll();
    ASSERT_TRUE(overlay.rollouts().log());
    ASSERT_TRUE(window.shown()->frame->reality);
    EXPECT_FALSE(overlay.rollouts().shown());
    EXPECT_EQ(reality().start, 0);
    EXPECT_FALSE(overlay.rollouts().rows().empty());
}

}  // namespace
}  // namespace mrose::gui
