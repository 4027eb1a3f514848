// What sensors of the surroundings gave, on the field and in the inspector.
#include <QImage>
#include <cmath>

#include <gtest/gtest.h>

#include "debug/run_frame.h"
#include "sensing/bumpers.h"
#include "sensing/infrared_ring.h"
#include "sensing/laser.h"
#include "sensing/line_camera.h"
#include "sensing/ranging.h"
#include "sensing/sonar_ring.h"
#include "widgets/field_drawing.h"
#include "widgets/field_fixture.h"
#include "widgets/inspector_rows.h"

namespace mrose {
namespace {

/// A robot at (-2, 0) that drives along x to a wall at x = 2, whose controller reads none of its sensors.
class FieldScansTest : public testing::Test {
protected:
    static constexpr double wallAt = 2;

    FieldScansTest() {
        view.setSize({800, 640});
        view.fit({{-5, -4}, {5, 4}}, {0, 0, 800, 640});
    }
    /// The frame after so many ticks of a robot with such a sensor.
    void show(const SensorPointer& sensor, std::int64_t tick, double speed = 0.5) {
        RobotType type = discRobot(0.3);
        type.sensors = {sensor};
        SmallWorld world(wallAhead(wallAt, 3));
        world.robot(type, {-2, 0, 0}, std::make_shared<const Told>(Command{speed, 0}), ideal());
        const auto scenario = std::make_shared<const Scenario>(world.parts());
        OpenedRun run{
            "scans", {}, std::make_shared<const BranchSetup>(BranchSetup{{}, scenario}), scenario->initialState()};
        TimeTravel travel(run);
        while (travel.tick() < tick) ASSERT_TRUE(travel.forward());
        frame = frameOf(travel);
    }
    QImage painted(std::initializer_list<FieldLayer> layers) const { return paintedFrame(frame, view, only(layers)); }
    /// Pixels that a layer changes within a box about a place, m.
    int changed(FieldLayer layer, const Point& at, double half) const {
        const QRectF box =
            QRectF(view.toPixels({at.x - half, at.y - half}), view.toPixels({at.x + half, at.y + half})).normalized();
        int count = 0;
        for (const QPoint& pixel : differences(painted({}), painted({layer}))) count += box.contains(pixel) ? 1 : 0;
        return count;
    }
    QString readout(FieldLayer layer, const Point& at) const {
        return scanReadout(view, frame, shownScans(frame, only({layer}), {}), view.toPixels(at));
    }
    InspectorRow rowOf(const QString& name, bool open = true) const {
        for (const InspectorRow& row : inspectorRows(frame, 0, [&](const QString&) { return open; }))
            for (const InspectorRow& child : row.children)
                if (row.name == "Readings" && child.name == name) return child;
        return {};
    }

    static SensorPointer laser(Nanoseconds period, Nanoseconds latency) {
        Laser::Options options;
        options.beams = 37;
        options.first = -std::numbers::pi / 2;
        options.step = std::numbers::pi / 36;
        options.errors.range = 8;
        options.latency = latency;
        return std::make_shared<const Laser>(SensorTraits{"laser", period}, options);
    }

    ViewTransform view;
    FieldFrame frame;
};

TEST_F(FieldScansTest, LaserMeetsTheWallWhereItIsAlthoughTheRobotDroveOn) {
    show(laser(500'000'000, 100'000'000), 100);
    EXPECT_GT(changed(FieldLayer::laser, {wallAt, 0}, 0.06), 5);
    EXPECT_GT(changed(FieldLayer::laser, {0, 0.1}, 0.05), 10) << "what it passed";
    EXPECT_EQ(changed(FieldLayer::laser, {-4, 0}, 0.3), 0) << "behind it";
    EXPECT_EQ(changed(FieldLayer::sonar, {0, 0}, 6), 0);
    const auto scans = scansOf(frame, 0);
    ASSERT_EQ(scans.size(), 1u);
    const Nanoseconds measured = scans[0].known.reading->measured;
    EXPECT_EQ(measured % 500'000'000, 0);
    EXPECT_NEAR(scans[0].eye.x, -2 + 0.5 * toSeconds(measured), 0.02);
    EXPECT_LT(scans[0].eye.x, frame.poseOf(0).x - 0.04);
    const double range = wallAt - scans[0].eye.x;
    const QString expected = QString("laser of 1: %1 m at 0.0\u00b0, %2 s ago")
                                 .arg(range, 0, 'f', 2)
                                 .arg(toSeconds(frame.now() - measured), 0, 'f', 2);
    EXPECT_EQ(readout(FieldLayer::laser, {wallAt, 0}), expected);
    EXPECT_EQ(readout(FieldLayer::laser, {-4, 3}), "");
}

TEST_F(FieldScansTest, SonarsEchoIsAnArcAtItsRange) {
    SonarRing::Options options;
    options.sonars = {{0.3, 0, 0}, {-0.3, 0, std::numbers::pi}};
    options.cone = 0.5;
    options.reflection = 0.5;
    options.errors.range = 6;
    show(std::make_shared<const SonarRing>(SensorTraits{"sonar", 0}, options), 20);
    EXPECT_GT(changed(FieldLayer::sonar, {wallAt, 0}, 0.1), 10);
    EXPECT_EQ(changed(FieldLayer::sonar, {-4, 0}, 0.5), 0) << "no echo from behind";
    EXPECT_TRUE(readout(FieldLayer::sonar, {wallAt, 0}).startsWith("sonar of 1: "));
    const InspectorRow rows = rowOf("sonar");
    ASSERT_EQ(rows.children.size(), 3u) << "a head and two sonars";
    EXPECT_EQ(rows.children[2].cells, (QStringList{"180.0", QString::fromUtf8("\u2013")}));
    EXPECT_EQ(rowOf("sonar", false).children.size(), 1u) << "elements are written where they are seen";
}

TEST_F(FieldScansTest, InfraredGlowsWhereSomethingIsNear) {
    InfraredRing::Options options;
    options.elements = {{0.3, 0, 0}, {-0.3, 0, std::numbers::pi}};
    options.range = 1;
    options.beam = 0.3;
    options.reference = 0.2;
    show(std::make_shared<const InfraredRing>(SensorTraits{"ir", 0}, options), 310);
    ASSERT_GT(frame.poseOf(0).x, 0.9);
    const QImage without = painted({}), with = painted({FieldLayer::infrared});
    const auto strength = [&](const Point& at) {
        const QPoint pixel = view.toPixels(at).toPoint();
        const QColor a = without.pixelColor(pixel), b = with.pixelColor(pixel);
        return std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue());
    };
    const double x = frame.poseOf(0).x;
    EXPECT_GT(strength({x + 0.45, 0}), 3 * strength({x - 0.6, 0}));
    EXPECT_GT(strength({x - 0.6, 0}), 0) << "that it is there is seen, too";
    EXPECT_TRUE(readout(FieldLayer::infrared, {x - 0.6, 0}).startsWith("ir of 1: intensity 0.0"));
    EXPECT_GT(changed(FieldLayer::infrared, {wallAt - 0.1, 0}, 0.04), 5);
    EXPECT_EQ(changed(FieldLayer::infrared, {wallAt + 0.15, 0}, 0.1), 0) << "light does not go through walls";
}

TEST_F(FieldScansTest, PressedBumpersStandOut) {
    const auto bumpers = std::make_shared<const Bumpers>(
        SensorTraits{"bumper", 0}, std::vector<Bumpers::Segment>{{-0.5, 1}, {0.5, std::numbers::pi * 2 - 1}});
    const QColor contact = Theme::light().contact;
    show(bumpers, 20);
    EXPECT_EQ(blobOf(painted({FieldLayer::bumpers}), contact).pixels, 0);
    EXPECT_GT(changed(FieldLayer::bumpers, {frame.poseOf(0).x, 0}, 0.5), 30);
    show(bumpers, 420);
    const Blob pressed = blobOf(painted({FieldLayer::bumpers}), contact);
    ASSERT_GT(pressed.pixels, 20);
    EXPECT_GT(view.toMetres(pressed.middle).x, frame.poseOf(0).x + 0.25) << "at its front";
    const auto at = [&](double ahead) { return readout(FieldLayer::bumpers, {frame.poseOf(0).x + ahead, 0}); };
    EXPECT_TRUE(at(0.31).startsWith(QString::fromUtf8("bumper of 1: pressed at 0.0\u00b0, ")))
        << at(0.31).toStdString();
    EXPECT_TRUE(at(-0.31).startsWith(QString::fromUtf8("bumper of 1: free at 180.0\u00b0, ")))
        << at(-0.31).toStdString();
    EXPECT_EQ(readout(FieldLayer::bumpers, position(frame.poseOf(0))), "");
    const InspectorRow rows = rowOf("bumper");
    ASSERT_EQ(rows.children.size(), 3u);
    EXPECT_EQ(rows.children[1].cells[1], "1");
    EXPECT_EQ(rows.children[2].cells[1], "0");
}

TEST_F(FieldScansTest, LineCamerasRowIsAStripOfWhatItSaw) {
    LineCamera::Options options;
    options.width = 41;
    options.view = 1;
    options.range = 5;
    show(std::make_shared<const LineCamera>(SensorTraits{"row", 0}, options), 20);
    ASSERT_EQ(scansOf(frame, 0).size(), 1u);
    const double x = scansOf(frame, 0)[0].eye.x, strip = 0.3 + 11 / view.scale();
    const auto seen = [&](double bearing) {
        const Point at{x + strip * std::cos(bearing), strip * std::sin(bearing)};
        return readout(FieldLayer::lineCameras, at);
    };
    // The wall is 3 m wide: its corners lie so far to either side.
    const double corner = std::atan2(1.5, wallAt - x);
    ASSERT_LT(corner, 0.48);
    EXPECT_TRUE(seen(0).startsWith("row of 1: obstacle, ")) << seen(0).toStdString();
    EXPECT_TRUE(seen(corner - 0.05).startsWith("row of 1: obstacle, ")) << seen(corner - 0.05).toStdString();
    EXPECT_TRUE(seen(corner + 0.05).startsWith("row of 1: nothing, ")) << seen(corner + 0.05).toStdString();
    EXPECT_EQ(seen(0.7), "") << "beyond its view";
    EXPECT_GT(changed(FieldLayer::lineCameras, {x + strip, 0}, 0.05), 20);
    EXPECT_EQ(changed(FieldLayer::lineCameras, {x - strip, 0}, 0.1), 0);
    const InspectorRow rows = rowOf("row");
    ASSERT_EQ(rows.children.size(), 42u);
    EXPECT_EQ(rows.children[21].cells, (QStringList{"0.0", "obstacle"}));
    EXPECT_EQ(rows.children[1].cells[1], "nothing");
}

TEST_F(FieldScansTest, RowAllRoundOfOneClassIsAWholeRing) {
    LineCamera::Options options;
    options.width = 36;
    options.view = 2 * std::numbers::pi;
    options.spacing = BeamFan::Spacing::angles;
    options.range = 0.5;
    show(std::make_shared<const LineCamera>(SensorTraits{"row", 0}, options), 20);
    const double x = scansOf(frame, 0).at(0).eye.x, strip = 0.3 + 11 / view.scale();
    for (int i = 0; i < 8; ++i) {
        const Point along = towards(i * std::numbers::pi / 4 + 0.1);
        EXPECT_GT(changed(FieldLayer::lineCameras, {x + strip * along.x, strip * along.y}, 0.04), 5) << i;
    }
}

}  // namespace
}  // namespace mrose
