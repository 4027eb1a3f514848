// Each layer draws where it should and nowhere else.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "sensing/body_sight.h"
#include "support/scenes.h"
#include "widgets/field_drawing.h"
#include "widgets/field_fixture.h"
#include "widgets/field_view.h"

namespace mrose {
namespace {

Trails trailOf(const std::vector<Point>& points, std::size_t body, std::size_t bodies) {
    auto block = std::make_shared<TrailBlock>(bodies);
    for (std::uint32_t i = 0; i < points.size(); ++i)
        for (std::size_t b = 0; b < bodies; ++b)
            block->at(b, i) =
                b == body ? TrailBlock::Place{static_cast<float>(points[i].x), static_cast<float>(points[i].y), 0}
                          : TrailBlock::Place{4.5, 3.5, 0};
    Trails trails;
    trails.pieces.push_back({block, 0, static_cast<std::uint32_t>(points.size()), true});
    return trails;
}

/// Driven, a tenth of a metre in a tick.
std::vector<Point> driven(const std::vector<Point>& corners) {
    std::vector<Point> points{corners.front()};
    for (std::size_t i = 1; i < corners.size(); ++i)
        for (int part = 1; part <= 15; ++part)
            points.push_back(corners[i - 1] + (part / 15.0) * (corners[i] - corners[i - 1]));
    return points;
}

/// Something for each layer, each in a place of its own.
FieldFrame everything() {
    FieldFrame frame = frameOfDiscs({{0, 0, 0}, {-3.5, 2.5, 0}});
    frame.trails = trailOf(driven({{-4, -3}, {-3, -3}, {-2, -2}}), 0, 3);
    frame.predicted = {{{2, -3, 0}, {3, -3, 0}, {4, -3, 0}}, {}};
    frame.predictedStep = nanosecondsPerSecond;
    frame.insights[0].decision.annotations = {{Annotation::Kind::point, "aim", 0, "", {{3, 2}}}};
    frame.lastTick.contacts = {{0, 1, 0, {0, 3}, {1, 0}, 0.02}};
    frame.insights[1].observed = true;
    frame.insights[1].observation.add(selfReading, 0, Pose{-2.5, 2.5, 0});
    frame.ghosts = {{"then", frame.scenario, {{2, 0, 0}, {-3.5, 2.5, 0}, {4.5, 3.5, 0}}, {}}};
    return frame;
}

double fromLine(const QPointF& p, const QPointF& a, const QPointF& b) {
    const QPointF along = b - a, by = p - a;
    const double share = std::clamp(QPointF::dotProduct(by, along) / QPointF::dotProduct(along, along), 0.0, 1.0);
    return std::hypot((by - share * along).x(), (by - share * along).y());
}

/// As a ball is after a goal.
TEST(FieldLayers, NoTrailLeadsToWhereABodyWasPut) {
    FieldFrame frame = everything();
    std::vector<Point> way = driven({{-4, -3}, {-3, -3}});
    const std::vector<Point> after = driven({{-3, -1}, {-2, -1}});
    way.insert(way.end(), after.begin(), after.end());
    frame.trails = trailOf(way, 0, 3);
    FieldView view;
    view.resize(800, 640);
    view.setFrame(std::make_shared<const FieldFrame>(frame));
    view.setLayers(FieldLayers::none());
    const QImage without = rendered(view);
    view.setLayers(only({FieldLayer::trails}));
    const QImage with = rendered(view);
    const auto drawn = [&](double x, double y) {
        const QPoint at = view.transform().toPixels({x, y}).toPoint();
        return with.pixel(at) != without.pixel(at);
    };
    EXPECT_TRUE(drawn(-3.5, -3));
    EXPECT_TRUE(drawn(-2.5, -1));
    EXPECT_FALSE(drawn(-3, -2));
}

TEST(FieldLayers, EachChangesItsOwnPlaceOnly) {
    FieldView view;
    view.resize(800, 640);
    view.setFrame(std::make_shared<const FieldFrame>(everything()));
    view.setLayers(FieldLayers::none());
    const QImage nothing = rendered(view);
    const auto px = [&](double x, double y) { return view.transform().toPixels({x, y}); };
    const double metre = view.transform().scale();
    const auto nearLine = [&](QPointF a, QPointF b, double reach) {
        return [=](const QPointF& p) { return fromLine(p, a, b) <= reach; };
    };
    const auto near = [&](QPointF a, double reach) { return nearLine(a, a + QPointF(1e-3, 0), reach); };
    const auto any = [](auto a, auto b) { return [=](const QPointF& p) { return a(p) || b(p); }; };
    struct Expected {
        FieldLayer layer;
        std::function<bool(const QPointF&)> where;
    };
    const std::vector<Expected> expected{
        {FieldLayer::trails, any(nearLine(px(-4, -3), px(-3, -3), 3), nearLine(px(-3, -3), px(-2, -2), 3))},
        {FieldLayer::headings, any(near(px(0, 0), 0.31 * metre), near(px(-3.5, 2.5), 0.31 * metre))},
        {FieldLayer::predicted, nearLine(px(2, -3), px(4, -3), 5)},
        {FieldLayer::targets, near(px(3, 2), 11)},
        {FieldLayer::contacts, near(px(0, 3), 8)},
        {FieldLayer::beliefs, nearLine(px(-3.5, 2.5), px(-2.5, 2.5), 0.3 * metre + 3)},
        {FieldLayer::ghosts, any(near(px(2, 0), 0.3 * metre + 2),
                                 any(near(px(-3.5, 2.5), 0.3 * metre + 2), near(px(4.5, 3.5), 0.1 * metre + 2)))},
        {FieldLayer::names, any(near(px(0, 0), 70), any(near(px(-3.5, 2.5), 70), near(px(4.5, 3.5), 60)))},
        {FieldLayer::legend, [&](const QPointF& p) { return p.x() > 500 && p.y() > 400; }},
    };
    for (const Expected& one : expected) {
        view.setLayers(only({one.layer}));
        if (one.layer == FieldLayer::legend) continue;  // shows what else is shown
        const std::vector<QPoint> changed = differences(nothing, rendered(view));
        EXPECT_GT(changed.size(), 20u) << static_cast<int>(one.layer);
        for (const QPoint& p : changed)
            if (!one.where(QPointF(p) + QPointF(0.5, 0.5))) {
                ADD_FAILURE() << "layer " << static_cast<int>(one.layer) << " at " << p.x() << ' ' << p.y();
                break;
            }
    }
    view.setLayers(only({FieldLayer::trails}));
    const QImage without = rendered(view);
    view.setLayers(only({FieldLayer::trails, FieldLayer::legend}));
    const std::vector<QPoint> legend = differences(without, rendered(view));
    EXPECT_GT(legend.size(), 200u);
    for (const QPoint& p : legend) ASSERT_TRUE(expected.back().where(p));
}

/// Also where there is nothing to explain.
TEST(FieldLayers, LegendAloneIsNoBox) {
    FieldView view;
    view.resize(800, 640);
    view.setFrame(std::make_shared<const FieldFrame>(frameOfDiscs({})));
    view.setLayers(FieldLayers::none());
    const QImage nothing = rendered(view);
    for (const FieldLayer other : {FieldLayer::legend, FieldLayer::names}) {
        view.setLayers(only({other}));
        const QImage without = rendered(view);
        view.setLayers(only({FieldLayer::legend, other}));
        EXPECT_TRUE(differences(without, rendered(view)).empty()) << static_cast<int>(other);
    }
    view.setLayers(only({FieldLayer::legend}));
    EXPECT_TRUE(differences(nothing, rendered(view)).empty());
}

TEST(FieldLayers, GridLinesLieAtRoundMetres) {
    FieldView view;
    view.resize(800, 640);
    view.setFrame(std::make_shared<const FieldFrame>(frameOfDiscs({})));
    view.setLayers(FieldLayers::none());
    view.viewport().zoom(1);  // otherwise what is fitted makes room for rulers
    const QImage nothing = rendered(view);
    view.setLayers(only({FieldLayer::grid}));
    const QImage grid = rendered(view);
    const int row = static_cast<int>(view.transform().toPixels({0, 1.5}).y());
    std::vector<double> metres;
    for (int x = 40; x < grid.width(); ++x)
        if (grid.pixel(x, row) != nothing.pixel(x, row)) metres.push_back(view.transform().toMetres({x + 0.5, 0}).x);
    ASSERT_GE(metres.size(), 9u);
    for (const double at : metres) EXPECT_NEAR(at, std::round(at), 1 / view.transform().scale());
}

TEST(FieldLayers, SensorFieldEndsAtRangeAndAngle) {
    constexpr double degree = std::numbers::pi / 180;
    FieldOptions options;
    options.robots = 32;                         // a field of 20 m x 10 m
    options.perception = cameraPerception(1.5);  // 90 degrees wide
    FieldFrame frame;
    frame.scenario = std::make_shared<const Scenario>(fieldScenario(options));
    frame.state = frame.scenario->initialState();
    for (RobotState& robot : frame.state.robots) robot.pose = {18, 8, 0};
    frame.state.robots[0].pose = {3, 3, 30 * degree};
    FieldView view;
    view.resize(800, 640);
    view.setFrame(std::make_shared<const FieldFrame>(frame));
    view.setLayers(FieldLayers::none());
    const QImage nothing = rendered(view);
    view.setLayers(only({FieldLayer::sensors}));
    const QImage with = rendered(view);
    const auto seen = [&](double angle, double range) {
        const QPoint p = view.transform()
                             .toPixels({3 + range * std::cos(angle * degree), 3 + range * std::sin(angle * degree)})
                             .toPoint();
        return nothing.pixel(p) != with.pixel(p);
    };
    EXPECT_TRUE(seen(30, 1.4) && seen(-12, 1.4) && seen(72, 1.4));
    EXPECT_FALSE(seen(30, 1.6) || seen(-18, 1.4) || seen(78, 1.4) || seen(210, 1));

    // Towards the south wall, whose inner edge is the x axis, it sees that far.
    frame.state.robots[0].pose = {3, 1, -90 * degree};
    view.setFrame(std::make_shared<const FieldFrame>(frame));
    const QImage there = rendered(view);
    const auto changed = [&](const Point& at) {
        const QPoint p = view.transform().toPixels(at).toPoint();
        return there.pixel(p) != nothing.pixel(p);
    };
    EXPECT_TRUE(changed({3, 0.05}) && changed({3.6, 0.2}));
    EXPECT_FALSE(changed({3, -0.35}) || changed({3.3, -0.3}));
}

TEST(FieldLayers, ArrowsOfImpulsesStayShort) {
    double before = 0;
    for (const double impulse : {0.01, 0.5, 2.0, 13.0, 500.0}) {
        EXPECT_GT(impulsePixels(impulse, 300), before);
        EXPECT_LT(before = impulsePixels(impulse, 300), longestImpulse);
        EXPECT_LT(impulsePixels(impulse, 30), 0.6 * 30) << "as small as the robots";
    }
    FieldFrame frame = frameOfDiscs({{-4, -3, 0}});
    frame.lastTick.contacts = {{0, noBody, 0, {0, 0}, {0, 1}, 500}};
    FieldView view;
    view.resize(800, 640);
    view.setFrame(std::make_shared<const FieldFrame>(frame));
    view.setLayers(FieldLayers::none());
    const QImage nothing = rendered(view);
    view.setLayers(only({FieldLayer::contacts}));
    const QPointF at = view.transform().toPixels({0, 0});
    double longest = 0;
    for (const QPoint& p : differences(nothing, rendered(view)))
        if (std::abs(p.x() + 0.5 - at.x()) < 5) longest = std::max(longest, std::abs(p.y() + 0.5 - at.y()));
    EXPECT_GT(longest, 0.9 * longestImpulse);
    EXPECT_LT(longest, longestImpulse + 3);
}

TEST(FieldLayers, NamesOfACrowdStandOffOneAnotherAndTheirColoursAreTheRobots) {
    std::vector<Pose> crowd;
    for (int i = 0; i < 8; ++i) crowd.push_back({0.62 * (i % 3) - 0.6, 0.62 * (i / 3), 0.0});
    FieldView view;
    view.resize(800, 640);
    view.setFrame(std::make_shared<const FieldFrame>(frameOfDiscs(crowd, {0.1, -0.4, 0})));
    view.setLayers(only({FieldLayer::names}));
    const QImage image = rendered(view);
    for (std::size_t robot = 0; robot < 8; ++robot)
        EXPECT_GT(blobOf(image, robotColour(robot), 8).pixels, 20) << "rim and chip of " << robot;
}

TEST(FieldLayers, FurtherCamerasAreDrawnAsWell) {
    constexpr double degree = std::numbers::pi / 180;
    FieldFrame frame = frameOfDiscs({{0, 0, 90 * degree}});
    ScenarioParts parts = frame.scenario->parts();
    BodySight sight;
    sight.fieldOfView = 60 * degree;
    sight.range = 2;
    sight.direction = 180 * degree;
    parts.scene.robotTypes[0].sensors.push_back(
        std::make_shared<const BodySensor>(sight, sight, 1, SensorTraits{"rear", 0}));
    frame.scenario = std::make_shared<const Scenario>(std::move(parts));
    FieldView view;
    view.resize(800, 640);
    view.setFrame(std::make_shared<const FieldFrame>(frame));
    view.setLayers(FieldLayers::none());
    const QImage nothing = rendered(view);
    view.setLayers(only({FieldLayer::sensors}));
    const QImage with = rendered(view);
    const auto seen = [&](double angle, double range) {
        const QPoint p =
            view.transform().toPixels({range * std::cos(angle * degree), range * std::sin(angle * degree)}).toPoint();
        return nothing.pixel(p) != with.pixel(p);
    };
    EXPECT_TRUE(seen(-90, 1.9) && seen(-65, 1.8) && seen(-115, 1.8));
    EXPECT_FALSE(seen(-90, 2.1) || seen(-55, 1.8) || seen(-125, 1.8) || seen(90, 1));
}

}  // namespace
}  // namespace mrose
