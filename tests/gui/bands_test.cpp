// Where robots may be: found out beside the window, for what it shows.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "debug/robot_bands.h"
#include "gui/overlay_fixture.h"
#include "gui/reality_fixture.h"
#include "gui/window_fixture.h"
#include "motion/learned_model.h"
#include "panels/plot_panel.h"
#include "reality/error_plot.h"
#include "reality/field_bands.h"
#include "session/session.h"
#include "widgets/field_fixture.h"
#include "widgets/plot_view.h"

namespace mrose::gui {
namespace {

class BandsTest : public WindowTest {
protected:
    void switchOn() {
        key(Qt::Key_Q);
        window.bands().settle();
    }
    const MotionBands* shownBands() const { return window.field().bands().bands.get(); }
    /// As a run of the shown state with other seeds has it.
    MotionBands bandsOfNow(Nanoseconds ahead = 5 * nanosecondsPerSecond) const {
        MotionSampler::Options options;
        options.ahead = ahead;
        return *samplerOf(window.shown()->frame->scenario).bands(state(), options, [] { return true; });
    }
};

TEST_F(BandsTest, AppearFollowTheCursorAndGo) {
    EXPECT_EQ(shownBands(), nullptr);
    window.session().seek(150);
    settle();
    const QImage without = rendered(window.field());
    switchOn();
    ASSERT_NE(shownBands(), nullptr);
    EXPECT_FALSE(window.field().bands().ofRun);
    EXPECT_EQ(*shownBands(), bandsOfNow());
    EXPECT_EQ(shownBands()->last(), 150 + 250);
    EXPECT_FALSE(differences(without, rendered(window.field())).empty());
    window.session().seek(90);
    settle();
    window.bands().settle();
    ASSERT_NE(shownBands(), nullptr);
    EXPECT_EQ(*shownBands(), bandsOfNow());
    key(Qt::Key_Q);
    EXPECT_EQ(shownBands(), nullptr);
    EXPECT_FALSE(window.bands().busy());
}

/// The answer comes by an event: until it does, the window goes on.
TEST_F(BandsTest, WindowGoesOnWhileTheyAreComputed) {
    FieldLayers layers = window.field().layers();
    layers.set(FieldLayer::uncertainty, true);
    window.field().setLayers(layers);
    EXPECT_TRUE(window.bands().busy());
    EXPECT_EQ(shownBands(), nullptr);
    EXPECT_FALSE(rendered(window.field()).isNull());
    // What was begun for the tick before is dropped.
    window.session().seek(120);
    window.session().settle();
    EXPECT_EQ(state().tick, 120);
    EXPECT_EQ(shownBands(), nullptr) << "that of another tick";
    window.bands().settle();
    ASSERT_NE(shownBands(), nullptr);
    EXPECT_EQ(shownBands()->tick, 120);
}

TEST_F(BandsTest, AnEditHasItsOwn) {
    window.session().seek(100);
    settle();
    switchOn();
    const MotionBands before = *shownBands();
    drag(pixelOf(2), pixelOf(2) + QPointF(30, 20));
    window.bands().settle();
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    ASSERT_NE(shownBands(), nullptr);
    EXPECT_EQ(*shownBands(), bandsOfNow());
    EXPECT_NE(*shownBands(), before);
}

TEST_F(BandsTest, ReachAsFarAheadAsIsAsked) {
    key(Qt::Key_Q, Qt::ShiftModifier);
    window.bands().settle();
    EXPECT_TRUE(window.actions()["layer_uncertainty"].isChecked());
    ASSERT_NE(shownBands(), nullptr);
    EXPECT_EQ(*shownBands(), bandsOfNow(10 * nanosecondsPerSecond));
    for (int i = 0; i < 3; ++i) key(Qt::Key_Q, Qt::AltModifier);
    window.bands().settle();
    EXPECT_EQ(shownBands()->last() - shownBands()->tick, 50);
}

TEST_F(BandsTest, RobotsWithoutNoiseHaveNoneWhichIsSaid) {
    const auto log = logOfDrives({{"a", {-2, 0, 0}, {0.3, 0}}}, 20);
    window.overlay().setFollows(false);
    window.show(overlaidRun(log, 1, 10));
    settle();
    switchOn();
    ASSERT_NE(shownBands(), nullptr);
    EXPECT_TRUE(shownBands()->empty());
    const QString tip = window.field().readoutAt(pixelOf(0));
    EXPECT_TRUE(tip.contains("no noise of its motion is known")) << tip.toStdString();
}

class RolloutBandsTest : public OverlayTest {
protected:
    void switchUncertainty(bool on) {
        if (window.actions()["layer_uncertainty"].isChecked() != on) window.actions()["layer_uncertainty"].trigger();
        window.bands().settle();
        window.plots().settle();
    }
    const PlotCurve* curve(const std::string& quantity) const {
        for (const PlotCurve& one : window.plots().view().curves())
            if (!one.ghost && one.id.startsWith(qtText(quantity + '\n'))) return &one;
        return nullptr;
    }
};

TEST_F(RolloutBandsTest, BesideALogTheyBeginWithTheRollout) {
    openLog(shipped());
    window.session().seek(200);
    settleAll();
    switchUncertainty(true);
    const RobotBands& shown = window.field().bands();
    ASSERT_NE(shown.bands, nullptr);
    EXPECT_TRUE(shown.ofRun);
    EXPECT_EQ(shown.bands->tick, 0);
    EXPECT_EQ(shown.bands, window.bands().ofRollout());
    // Runs of the same rollout, whose robots draw what their network knows of its noise and are given the log's
    // commands.
    const RolloutRequest& request = overlay.rollouts().requests()[*overlay.rollouts().shown()];
    const LogWorld& world = overlay.rollouts().world();
    const std::uint64_t first =
        sampleSeed(0, world.sessions()[request.session].name,
                   {.trajectory = &world.trajectory(request.session, 0), .time = request.start}, 0);
    std::vector<Pose> samples;
    Pose around;
    for (int seed = -1; seed < MotionSampler::Options{}.samples; ++seed) {
        ScenarioParts parts = overlay.rollouts()
                                  .world()
                                  .partsAt(request.session, request.start, request.steps * WindowOptions{}.step)
                                  .parts;
        if (seed >= 0)
            for (auto& model : parts.scene.models) model = learnedModel(*model)->drawn(MotionDraw::noisy);
        const Scenario scenario(std::move(parts));
        WorldState state =
            scenario.initialState(seed < 0 ? overlay.rollouts().log()->seed : first + static_cast<std::uint64_t>(seed));
        StepBuffers buffers;
        for (int tick = 0; tick < 200; ++tick) step(scenario, state, buffers);
        const Pose& pose = state.robots[0].pose;
        seed < 0 ? void(around = pose) : samples.push_back(pose);
    }
    EXPECT_EQ(*shown.bands->at(0, 200), regionOf(samples, around));
    // The run itself is what errors are measured from.
    EXPECT_EQ(around, window.shown()->frame->state.robots[0].pose);
    switchUncertainty(false);
    EXPECT_EQ(window.bands().ofRollout(), nullptr);
    EXPECT_EQ(window.field().bands().bands, nullptr);
}

TEST_F(RolloutBandsTest, ErrorsArePlottedOnWhatIsExpectedOfThem) {
    openLog(shipped());
    window.errorPlot().setOn(true);
    window.errorPlot().settle();
    const std::string robot = overlay.rollouts().world().robots().front().name;
    for (const char* quantity : {"x", "heading"}) ASSERT_TRUE(window.plots().add({quantity, robot}));
    window.plots().settle();
    ASSERT_NE(curve("error"), nullptr);
    EXPECT_TRUE(curve("error")->expected.isEmpty());
    switchUncertainty(true);
    const MotionBands& bands = *window.bands().ofRollout();
    const PoseRegion& region = *bands.at(0, 100);
    const auto at100 = [&](const std::string& quantity) {
        for (const ExpectedRange& range : curve(quantity)->expected)
            if (range.tick == 100) return range;
        return ExpectedRange{};
    };
    const auto &half = region.of(RegionShare::half), &most = region.of(RegionShare::most);
    EXPECT_EQ(at100("error"), (ExpectedRange{100, 0, 100 * half.error, 0, 100 * most.error}));
    EXPECT_EQ(at100("x"), (ExpectedRange{100, half.x.low, half.x.high, most.x.low, most.x.high}));
    EXPECT_NEAR(at100("heading_error").mostHigh, most.headingError * 180 / std::numbers::pi, 1e-9);
    const double heading = wrapAngle(region.heading) * 180 / std::numbers::pi;
    EXPECT_LE(at100("heading").mostLow, heading);
    EXPECT_GE(at100("heading").mostHigh, heading);
    switchUncertainty(false);
    EXPECT_TRUE(curve("error")->expected.isEmpty());
}

TEST(ExpectedRanges, AreShadedBehindTheirCurve) {
    PlotView view;
    view.resize(600, 300);
    view.setTheme(Theme::light());
    PlotCurve curve;
    curve.id = curve.name = "a";
    curve.unit = "m";
    curve.colour = QColor(200, 0, 0);
    curve.sample = [](std::int64_t, std::int64_t, std::int64_t, QVector<QPointF>& points) {
        points = {{0, -0.5}, {100, 0.5}};
    };
    curve.at = [](std::int64_t tick) { return 0.01 * static_cast<double>(tick) - 0.5; };
    for (const double tick : {0.0, 50.0, 100.0}) curve.expected.append({tick, -1, 1, -2, 2});
    view.setCurves({curve});
    view.setTime({0, 100, 100, nanosecondsPerSecond / 50});
    view.show();
    view.draw();
    const QImage image = rendered(view);
    const auto colour = [&](double tick, double number) {
        return image.pixelColor(view.placeOf("a", tick, number)->toPoint());
    };
    const ExpectedColours colours = expectedColours(curve, Qt::white);
    EXPECT_EQ(colour(30, 0.6), colours.half);
    EXPECT_EQ(colour(70, -0.6), colours.half);
    EXPECT_EQ(colour(30, 1.6), colours.most);
    EXPECT_EQ(colour(70, -1.6), colours.most);
    EXPECT_EQ(colour(30, 2.1), QColor(Qt::white));
    EXPECT_LE(view.rangeOf(0).first, -2);
    EXPECT_GE(view.rangeOf(0).second, 2);
}

}  // namespace
}  // namespace mrose::gui
