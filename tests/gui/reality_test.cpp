// How real robots and other models are seen beside the simulated ones.
#include <QApplication>
#include <cmath>
#include <numbers>

#include "gui/reality_fixture.h"
#include "gui/window_fixture.h"
#include "panels/side_view.h"
#include "widgets/field_drawing.h"
#include "widgets/field_fixture.h"
#include "widgets/field_readout.h"
#include "widgets/real_readout.h"

namespace mrose::gui {
namespace {

const RealDrive straight{"a", {-3, -2, 0}, {0.5, 0}, {{5.0, 6.0}}};
const RealDrive round{"b", {1, 1, 0}, {0.4, 0.4}};

class RealityTest : public testing::Test {
protected:
    RealityTest() : log(logOfDrives({straight, round}, 12)) { field.resize(800, 640); }

    /// The run, begun at 1 s of the log, after so many seconds.
    void show(double seconds, double gain = 0.5, double duration = 10, const Reality* reality = nullptr) {
        OpenedRun run = overlaidRun(log, 1, duration, gain);
        if (reality != nullptr) run.reality = std::make_shared<const Reality>(*reality);
        TimeTravel travel(run);
        while (travel.tick() < run.setup->scene().ticksOf(fromSeconds(seconds))) ASSERT_TRUE(travel.forward());
        frame = std::make_shared<const FieldFrame>(frameOf(travel));
        field.setFrame(frame);
        rendered(field);  // it knows its size then
    }
    QImage picture(std::initializer_list<FieldLayer> layers) {
        field.setLayers(only(layers));
        return rendered(field);
    }
    QPointF px(const Point& at) const { return field.transform().toPixels(at); }
    double metre() const { return field.transform().scale(); }
    /// Whether two pictures differ within so many pixels of a place.
    static bool differ(const QImage& a, const QImage& b, const QPointF& at, double reach = 1.5) {
        for (const QPoint& p : differences(a, b))
            if (std::hypot(p.x() + 0.5 - at.x(), p.y() + 0.5 - at.y()) <= reach) return true;
        return false;
    }

    std::shared_ptr<const Log> log;
    FieldView field;
    std::shared_ptr<const FieldFrame> frame;
};

TEST_F(RealityTest, OutlinesLieWhereTheTruthSays) {
    show(3);
    const QImage without = picture({}), with = picture({FieldLayer::reality});
    std::vector<QPointF> expected;
    for (const RealDrive& drive : {straight, round}) {
        const Pose real = drive.poseAt(4);
        for (int i = 0; i < 16; ++i) {
            const double angle = i * std::numbers::pi / 8;
            const QPointF rim = px({real.x + 0.3 * std::cos(angle), real.y + 0.3 * std::sin(angle)});
            EXPECT_TRUE(differ(without, with, rim)) << drive.robot << ' ' << angle;
        }
    }
    // Nothing is drawn but the rims and the lines from the simulated ones.
    for (const QPoint& p : differences(without, with)) {
        const QPointF at(p.x() + 0.5, p.y() + 0.5);
        double off = 1e9;
        for (std::size_t i = 0; i < 2; ++i) {
            const QPointF real = px(position((i == 0 ? straight : round).poseAt(4)));
            const QPointF simulated = px(position(frame->poseOf(i)));
            off = std::min(off, std::abs(std::hypot((at - real).x(), (at - real).y()) - 0.3 * metre()));
            const QPointF along = real - simulated, by = at - simulated;
            const double share =
                std::clamp(QPointF::dotProduct(by, along) / QPointF::dotProduct(along, along), 0.0, 1.0);
            off = std::min(off, std::hypot((by - share * along).x(), (by - share * along).y()));
        }
        ASSERT_LE(off, 4.5) << p.x() << ' ' << p.y();
    }
}

/// Of a real robot the outline has the simulated one's hue, but not its colour.
TEST_F(RealityTest, RobotsAreToldFromSimulatedOnesAndTheirBodiesShowThrough) {
    show(3);
    const QImage with = picture({FieldLayer::reality});
    for (std::size_t i = 0; i < 2; ++i) {
        const QPointF real = px(position((i == 0 ? straight : round).poseAt(4)));
        const QRect box(real.toPoint() - QPoint(30, 30), QSize(61, 61));
        for (const Theme& theme : {Theme::light(), Theme::darkOne()}) {
            EXPECT_GT(contrast(realColour(i, theme), robotColour(i)), 1.5) << i;
            EXPECT_LT(std::abs(realColour(i, theme).hue() - robotColour(i).hue()), 12) << i;
        }
        EXPECT_GT(blobOf(with.copy(box), realColour(i, Theme::light()), 20).pixels, 60) << i;
        // Away from the line and the nose the outline is hollow: the floor is seen in it.
        EXPECT_EQ(with.pixel((real + QPointF(-3, 14)).toPoint()), with.pixel(QPoint(400, 20))) << i;
    }
}

TEST_F(RealityTest, TrailsAreAsLongAsTheSimulatedOnesAndBreakWhereTheTruthIsUnknown) {
    show(7, 1);
    const QImage without = picture({FieldLayer::trails}), with = picture({FieldLayer::trails, FieldLayer::reality});
    const auto seenAt = [&](double logTime) {
        return differ(without, with, px(position(straight.poseAt(logTime))), 3);
    };
    for (const double time : {1.1, 2.5, 4.8, 6.2, 7.0}) EXPECT_TRUE(seenAt(time)) << time;
    for (const double time : {0.5, 5.3, 5.5, 5.7}) EXPECT_FALSE(seenAt(time)) << time;
    // Ahead of it, fainter, for two seconds.
    EXPECT_TRUE(seenAt(9.5));
    EXPECT_FALSE(seenAt(10.3));
    const auto strength = [&](double time) {
        const QColor floor = without.pixelColor(QPoint(400, 20));
        double most = 0;
        const QPointF at = px(position(straight.poseAt(time)));
        for (int y = -4; y <= 4; ++y) {
            const QColor c = with.pixelColor((at + QPointF(0, y)).toPoint());
            most = std::max<double>(most, std::abs(c.red() - floor.red()) + std::abs(c.green() - floor.green()) +
                                              std::abs(c.blue() - floor.blue()));
        }
        return most;
    };
    EXPECT_LT(strength(9.4), 0.7 * strength(6.5));
}

TEST_F(RealityTest, WhoIsNotSeenStandsWhereItWasLastAndIsSaidToBeLost) {
    show(4.5);
    const std::vector<RealRobot> robots = realRobots(*frame);
    ASSERT_EQ(robots.size(), 2u);
    ASSERT_TRUE(robots[0].lostFor);
    EXPECT_NEAR(toSeconds(*robots[0].lostFor), 0.5, 1e-9);
    EXPECT_NEAR(robots[0].pose.x, straight.poseAt(5).x, 1e-9);
    EXPECT_FALSE(robots[0].apart);
    EXPECT_TRUE(robots[1].known());
    EXPECT_EQ(realReadout(*frame, robots[0]), "real sim a: no ground truth for 0.5 s");
    const QImage without = picture({}), with = picture({FieldLayer::reality});
    EXPECT_TRUE(differ(without, with, px({straight.poseAt(5).x + 0.3, -2}), 3));
}

/// No real robot drove in a log that a simulation made.
TEST_F(RealityTest, RobotsOfSyntheticLogsAreNotCalledReal) {
    const auto made = std::make_shared<Log>(*log);
    made->synthetic = true;
    log = made;
    show(3);
    EXPECT_STREQ(realWord(*frame), "logged");
    const QString said = field.readoutAt(px(position(frame->poseOf(0))));
    EXPECT_TRUE(said.contains("logged sim a: ")) << said.toStdString();
    EXPECT_FALSE(said.contains("real")) << said.toStdString();
    QImage image(10, 10, QImage::Format_RGB32);
    QPainter painter(&image);
    FieldFocus focus;
    focus.selected = 0;
    std::vector<FieldLabel> labels;
    addRealNames({painter, field.transform(), Theme::light()}, *frame, focus, labels);
    ASSERT_EQ(labels.size(), 1u);
    EXPECT_TRUE(labels[0].text.startsWith("logged: ")) << labels[0].text.toStdString();
}

TEST_F(RealityTest, ReadOutSaysHowFarItIs) {
    show(3);
    const Pose real = straight.poseAt(4), simulated = frame->poseOf(0);
    const PoseError error{std::hypot(real.x - simulated.x, real.y - simulated.y),
                          std::abs(real.heading - simulated.heading)};
    EXPECT_GT(error.position, 0.3);
    const QString said = field.readoutAt(px(position(simulated)));
    EXPECT_TRUE(said.contains("real sim a: " + lengthText(error.position))) << said.toStdString();
    EXPECT_EQ(field.readoutAt(px(position(real))).count("real sim a"), 1);
    field.setLayers(only({}));
    EXPECT_FALSE(field.readoutAt(px(position(simulated))).contains("real"));
}

TEST_F(RealityTest, ModelsHaveTheirOwnColoursAndLines) {
    const OpenedRun run = overlaidRun(log, 1, 10);
    Reality reality = *run.reality;
    for (int m = 0; m < 2; ++m) {
        Reality::ModelRollout rollout{m == 0 ? "first" : "second", 100'000'000, {{}, {}}};
        for (int i = 0; i <= 50; ++i) rollout.poses[0].push_back({-4.0 + 0.1 * i, 0.5 + m, 0});
        reality.models.push_back(rollout);
    }
    show(3, 0.5, 10, &reality);
    const QImage without = picture({FieldLayer::trails}), with = picture({FieldLayer::trails, FieldLayer::models});
    for (std::size_t m = 0; m < 2; ++m) {
        const double y = 0.5 + static_cast<double>(m);
        const Blob blob = blobOf(with, modelColour(m), 16);
        EXPECT_GT(blob.pixels, 20) << m;
        EXPECT_NEAR(field.transform().toMetres(blob.middle).y, y, 0.1);
        EXPECT_TRUE(differ(without, with, px({-1 + 0.3, y}))) << "the outline";
        EXPECT_TRUE(differ(without, with, px({-3, y}), 8)) << "the trail";
        EXPECT_FALSE(differ(without, with, px({0.5, y}), 8)) << "no future";
    }
    field.setLayers(only({FieldLayer::models}));
    const QString said = field.readoutAt(px(position(frame->poseOf(0))));
    EXPECT_TRUE(said.contains("first: 2.50 m, 0.0") && said.contains("second: 3.50 m, 0.0")) << said.toStdString();
    show(6, 0.5, 10, &reality);
    EXPECT_EQ(differences(picture({}), picture({FieldLayer::models})).size(), 0u) << "beyond its end";
}

TEST_F(RealityTest, FitShowsWhatIsDrivenOutsideThePlace) {
    log = logOfDrives({RealDrive{"a", {0, 0, 0}, {1, 0}}}, 12);
    show(1);
    const Area shown = field.transform().shown();
    EXPECT_GE(shown.most.x, 12);
}

TEST_F(RealityTest, RobotsOfTheLogThatAreNotInTheWorldAreNamed) {
    // The first robot has no ground truth at the start: it is not in the world.
    log = logOfDrives({RealDrive{"a", {-3, -2, 0}, {0.5, 0}, {{0.5, 1.5}}}, round}, 12);
    show(3);
    ASSERT_EQ(frame->scene().robots.size(), 1u);
    const std::vector<RealRobot> robots = realRobots(*frame);
    ASSERT_EQ(robots.size(), 2u);
    EXPECT_FALSE(robots[0].body);
    EXPECT_EQ(robots[1].body, 0u);
    const QImage without = picture({FieldLayer::names}), with = picture({FieldLayer::names, FieldLayer::reality});
    EXPECT_TRUE(differ(without, with, px({straight.poseAt(4).x, straight.poseAt(4).y + 0.3})));
    EXPECT_GT(differences(without, with).size(), 400u) << "with a name";
}

/// Overlapping bodies are named as one: the words stand beside both, whichever side they take.
TEST_F(RealityTest, ErrorIsWrittenBesideBothBodies) {
    for (const double seconds : {0.5, 1.0, 3.0}) {
        show(seconds);
        FieldFocus focus;
        focus.selected = 0;
        QImage image(800, 640, QImage::Format_RGB32);
        QPainter painter(&image);
        const Theme theme = Theme::light();
        std::vector<FieldLabel> labels;
        addRealNames({painter, field.transform(), theme}, *frame, focus, labels);
        ASSERT_EQ(labels.size(), 1u);
        const FieldLabel& label = labels.front();
        const Point real = position(straight.poseAt(1 + seconds)), simulated = position(frame->poseOf(0));
        const double apart = std::hypot(real.x - simulated.x, real.y - simulated.y);
        const auto covers = [&](const Point& body) {
            return metre() * (std::hypot(label.at.x - body.x, label.at.y - body.y) + 0.3) <= label.clearance;
        };
        EXPECT_TRUE(covers(real)) << seconds;
        EXPECT_EQ(covers(simulated), apart < 0.6) << seconds;
    }
}

}  // namespace
}  // namespace mrose::gui
