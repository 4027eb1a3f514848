// What sensors reported last, of simulated robots and of the real ones beside them: where it is drawn, what is said of
// it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "debug/sensor_looks.h"
#include "gui/reality_fixture.h"
#include "sensing/body_sight.h"
#include "support/units.h"
#include "widgets/field_fixture.h"
#include "widgets/field_view.h"
#include "widgets/inspector_rows.h"

namespace mrose::gui::reported {
namespace {

const RealDrive ahead{"a", {-3, -2, 0}, {0.4, 0}};
const RealDrive bend{"b", {0, 0, 0}, {0.3, 0.3}};
constexpr double off = 0.4;  // m
constexpr Nanoseconds realPeriod = 250 * ms, period = 240 * ms, late = 40 * ms;
const Point post{2, -3};

/// Sees all round, all there is.
SensorPointer camera() {
    BodySight sight;
    sight.latency = late;
    return std::make_shared<const BodySensor>(sight, sight, 1, SensorTraits{"camera", period});
}

class ReadingsTest : public testing::Test {
protected:
    explicit ReadingsTest(std::vector<SensorPointer> sensors = {camera()}) : sensors_(std::move(sensors)) {
        Log made = *logOfDrives({ahead, bend}, 12);
        addLooks(made, {ahead, bend}, {post}, realPeriod, off);
        log = std::make_shared<const Log>(std::move(made));
        field.resize(800, 640);
    }
    TimeTravel travelled(std::int64_t tick) const {
        TimeTravel travel(overlaidRun(log, 1, 10, 0.5, sensors_));
        while (travel.tick() < tick) EXPECT_TRUE(travel.forward());
        return travel;
    }
    /// The run, begun at 1 s of the log, after so many ticks of 20 ms.
    void show(std::int64_t tick) {
        frame = std::make_shared<const FieldFrame>(frameOf(travelled(tick)));
        field.setFrame(frame);
        rendered(field);  // it knows its size then
    }
    QImage picture(const FieldLayers& layers) {
        field.setLayers(layers);
        return rendered(field);
    }
    QPointF px(const Point& at) const { return field.transform().toPixels(at); }
    static double nearest(const std::vector<QPoint>& changed, const QPointF& at) {
        double least = 1e9;
        for (const QPoint& p : changed) least = std::min(least, std::hypot(p.x() + 0.5 - at.x(), p.y() + 0.5 - at.y()));
        return least;
    }
    const ReportedSubject& subject(const SensorLook& look, const std::string& name) const {
        const auto found = std::find_if(look.subjects.begin(), look.subjects.end(),
                                        [&](const ReportedSubject& one) { return one.name == name; });
        if (found == look.subjects.end()) throw std::out_of_range("no subject " + name);
        return *found;
    }

    std::vector<SensorPointer> sensors_;
    std::shared_ptr<const Log> log;
    FieldView field;
    std::shared_ptr<const FieldFrame> frame;
};

class WithoutCamera : public ReadingsTest {
protected:
    WithoutCamera() : ReadingsTest({}) {}
};

TEST_F(WithoutCamera, RealReadingsAreOfTheInstantOfTheirLook) {
    show(155);  // 3.1 s, 4.1 s of the log: it looked at 4.0 s
    const std::vector<SensorLook> looks = realLooks(*frame, 0);
    ASSERT_EQ(looks.size(), 1u);
    EXPECT_EQ(looks[0].sensor, "camera");
    EXPECT_EQ(looks[0].measured, 3000 * ms);
    ASSERT_TRUE(looks[0].eye);
    const Pose eye = ahead.poseAt(4);
    EXPECT_NEAR(looks[0].eye->x, eye.x, 1e-3);
    EXPECT_NEAR(looks[0].eye->y, eye.y, 1e-3);
    for (const auto& [name, at] : {std::pair{"sim b", position(bend.poseAt(4))}, {"landmark 1", post}}) {
        const ReportedSubject& of = subject(looks[0], name);
        ASSERT_TRUE(of.truth);
        EXPECT_LT(distance(*of.truth, at), 2e-3) << name;
        EXPECT_NEAR(of.range, distance(position(eye), at) + off, 1e-9) << name;
        EXPECT_NEAR(distance(looks[0].reported(of), at), off, 3e-3) << name;
        EXPECT_NEAR(distance(looks[0].reported(of), position(eye)), of.range, 2e-3) << name;
    }
    EXPECT_TRUE(simulatedLooks(*frame, 0).empty()) << "its player reads none of what every robot has";
}

/// As late as the simulated one of that name.
TEST_F(ReadingsTest, RealStampsAreAsLateAsTheSensorIs) {
    show(155);
    const std::vector<SensorLook> looks = realLooks(*frame, 0);
    ASSERT_EQ(looks.size(), 1u);
    EXPECT_EQ(looks[0].measured, 3000 * ms - late);
}

TEST_F(WithoutCamera, RealReadingsGoWhereNoOtherLookFollows) {
    Log cut = *log;
    std::vector<Look>& looks = cut.robots[0].trajectories[0].sensors[0].looks;
    std::erase_if(looks, [](const Look& look) { return look.time > 4000 * ms && look.time < 8000 * ms; });
    log = std::make_shared<const Log>(std::move(cut));
    for (const auto& [tick, there] : {std::pair{150, true}, {168, true}, {169, false}, {349, false}, {350, true}}) {
        show(tick);  // 4.0 s of the log is tick 150, a pause and a half later 168.75
        EXPECT_EQ(realLooks(*frame, 0).size(), there ? 1u : 0u) << tick;
        EXPECT_EQ(realLooks(*frame, 1).size(), 1u) << tick;
    }
}

TEST_F(ReadingsTest, SimulatedReadingsAreOfTheInstantOfTheirMeasurement) {
    for (const std::int64_t tick : {100, 107, 112}) {
        show(tick);
        for (std::size_t robot = 0; robot < 2; ++robot) {
            const std::vector<SensorLook> looks = simulatedLooks(*frame, robot);
            ASSERT_EQ(looks.size(), 1u) << tick;
            EXPECT_EQ(looks[0].sensor, "camera");
            EXPECT_EQ(looks[0].measured % period, 0);
            // It came at the last control instant, by which it was there.
            EXPECT_LE(looks[0].measured + late, frame->scene().timeOf(frame->insights[robot].tick));
            EXPECT_GT(looks[0].measured + late + period, frame->scene().timeOf(frame->insights[robot].tick));
            const auto then = frameOf(travelled(looks[0].measured / frame->scene().tickLength));
            ASSERT_TRUE(looks[0].eye);
            EXPECT_NEAR(looks[0].eye->x, then.poseOf(robot).x, 1e-6);
            const ReportedSubject& other = subject(looks[0], robot == 0 ? "sim b" : "sim a");
            ASSERT_TRUE(other.truth);
            EXPECT_LT(distance(*other.truth, position(then.poseOf(1 - robot))), 1e-6);
            EXPECT_LT(distance(looks[0].reported(other), *other.truth), 1e-5) << "it has no noise";
        }
    }
}

/// However one came there.
TEST_F(ReadingsTest, AreTheSameWhereOneGoesStraightThere) {
    TimeTravel played = travelled(0), gone = travelled(140);
    for (std::int64_t tick = 1; tick < 140; ++tick) {
        ASSERT_TRUE(played.forward());
        if (tick % 3 != 0) continue;
        ASSERT_TRUE(gone.seek(tick));
        const FieldFrame here = frameOf(played), there = frameOf(gone);
        for (std::size_t robot = 0; robot < 2; ++robot) {
            const std::vector<SensorLook> a = simulatedLooks(here, robot), b = simulatedLooks(there, robot);
            ASSERT_EQ(a.size(), b.size()) << tick;
            for (std::size_t i = 0; i < a.size(); ++i) {
                EXPECT_EQ(a[i].measured, b[i].measured) << tick;
                EXPECT_EQ(a[i].eye, b[i].eye) << tick;
                EXPECT_EQ(a[i].subjects.size(), b[i].subjects.size()) << tick;
            }
        }
        if (tick > 20) {
            EXPECT_EQ(simulatedLooks(here, 0).size(), 1u) << tick;
        }
    }
}

TEST_F(ReadingsTest, MarksAndRaysLieWhereTheReadingsAre) {
    show(155);
    const FieldLayers real = only({FieldLayer::reality});
    const QImage without = picture(real);
    const QImage with = picture(only({FieldLayer::reality, FieldLayer::readings}));
    const std::vector<QPoint> changed = differences(without, with);
    std::vector<std::pair<QPointF, QPointF>> rays, gaps;
    for (std::size_t robot = 0; robot < 2; ++robot)
        for (const auto& looks : {simulatedLooks(*frame, robot), realLooks(*frame, robot)})
            for (const SensorLook& look : looks)
                for (const ReportedSubject& one : look.subjects) {
                    rays.emplace_back(px(position(*look.eye)), px(look.reported(one)));
                    gaps.emplace_back(px(look.reported(one)), px(*one.truth));
                }
    EXPECT_EQ(rays.size(), 2u + 4u) << "the camera knows no landmarks";
    for (const auto& [from, to] : rays) EXPECT_LT(nearest(changed, to), 5);
    for (const auto& [from, to] : gaps) EXPECT_LT(nearest(changed, to), 5);
    rays.insert(rays.end(), gaps.begin(), gaps.end());
    for (const QPoint& p : changed) {
        double least = 1e9;
        for (const auto& [from, to] : rays) {
            const QPointF at(p.x() + 0.5, p.y() + 0.5), along = to - from, by = at - from;
            const double share = std::clamp(
                QPointF::dotProduct(by, along) / std::max(1e-9, QPointF::dotProduct(along, along)), 0.0, 1.0);
            least = std::min(least, std::hypot((by - share * along).x(), (by - share * along).y()));
        }
        ASSERT_LE(least, 8) << p.x() << ' ' << p.y();
    }
}

/// Real ones are hollow, simulated ones filled.
TEST_F(ReadingsTest, MarksOfRealReadingsAreHollow) {
    show(155);
    const QImage without = picture(only({FieldLayer::reality}));
    const QImage with = picture(only({FieldLayer::reality, FieldLayer::readings}));
    const auto filled = [&](const SensorLook& look, const std::string& name) {
        const QPoint at = px(look.reported(subject(look, name))).toPoint();
        return with.pixel(at) != without.pixel(at);
    };
    const auto real = realLooks(*frame, 0), simulated = simulatedLooks(*frame, 0);
    ASSERT_TRUE(!real.empty() && !simulated.empty());
    EXPECT_TRUE(filled(simulated[0], "sim b"));
    EXPECT_FALSE(filled(real[0], "landmark 1"));
}

TEST_F(ReadingsTest, WithoutTheLayerThoseOfTheSelectedRobotAreShownBesideTheReal) {
    show(155);
    const auto marks = [&](const FieldLayers& layers) {
        FieldFocus focus;
        focus.selected = field.selected();
        std::vector<std::size_t> robots;
        for (const RobotLooks& of : shownLooks(*frame, layers, focus)) {
            robots.push_back(of.robot);
            EXPECT_EQ(of.real.empty(), !layers.has(FieldLayer::reality));
        }
        return robots;
    };
    using Robots = std::vector<std::size_t>;
    EXPECT_EQ(marks(only({FieldLayer::reality})), Robots{});
    EXPECT_EQ(marks(only({FieldLayer::reality, FieldLayer::readings})), (Robots{0, 1}));
    EXPECT_EQ(marks(only({FieldLayer::readings})), (Robots{0, 1}));
    field.setSelected(1);
    EXPECT_EQ(marks(only({FieldLayer::reality})), Robots{1});
    EXPECT_EQ(marks(FieldLayers::none()), Robots{});
    FieldFrame alone = *frame;
    alone.reality = nullptr;
    frame = std::make_shared<const FieldFrame>(std::move(alone));
    EXPECT_EQ(shownLooks(*frame, only({FieldLayer::reality}), {1}).size(), 0u);
}

TEST_F(ReadingsTest, InspectorSetsRealBesideSimulated) {
    show(155);
    const std::vector<InspectorRow> rows = inspectorRows(*frame, 0, [](const QString&) { return false; });
    const auto section = std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row.name == "Readings"; });
    ASSERT_NE(section, rows.end());
    ASSERT_EQ(section->children.size(), 1u);
    const InspectorRow& camera = section->children[0];
    EXPECT_EQ(camera.name, "camera");
    const SensorLook real = realLooks(*frame, 0)[0], simulated = simulatedLooks(*frame, 0)[0];
    const auto number = [](double value, int digits) { return QString::number(value, 'f', digits); };
    const auto age = [&](const SensorLook& look) { return number(toSeconds(frame->now() - look.measured), 2) + " s"; };
    const auto cells = [&](const QString& name) {
        for (const InspectorRow& row : camera.children)
            if (row.name == name) return row.cells;
        return QStringList{};
    };
    const QString none = QString::fromUtf8("\u2013"), unit = QString::fromUtf8("\u00b0");
    EXPECT_EQ(cells("age"), (QStringList{"", age(real), "", age(simulated)}));
    EXPECT_EQ(cells("subject"), (QStringList{"m", unit, "m", unit}));
    QStringList expected;
    for (const SensorLook& look : {real, simulated}) {
        const ReportedSubject& of = subject(look, "sim b");
        expected << number(of.range, 2) << number(of.bearing / degree, 1);
    }
    EXPECT_EQ(cells("sim b"), expected);
    ASSERT_EQ(cells("landmark 1").size(), 4);
    EXPECT_NE(cells("landmark 1")[0], none);
    EXPECT_EQ(cells("landmark 1").mid(2), (QStringList{none, none})) << "the simulated one knows no landmarks";
}

TEST_F(WithoutCamera, InspectorHasNoReadingsWhereNothingReports) {
    FieldFrame without = frameOf(travelled(20));
    without.reality = nullptr;
    for (const InspectorRow& row : inspectorRows(without, 0, [](const QString&) { return false; }))
        EXPECT_NE(row.name, "Readings");
}

}  // namespace
}  // namespace mrose::gui::reported
