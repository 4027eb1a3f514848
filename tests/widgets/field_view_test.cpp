#include "widgets/field_view.h"

#include <QApplication>
#include <QBuffer>
#include <QSignalSpy>
#include <QSvgGenerator>
#include <QSvgRenderer>
#include <QTest>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "widgets/field_drawing.h"
#include "widgets/field_fixture.h"
#include "widgets/field_readout.h"
#include "widgets/field_view_fixture.h"

namespace mrose {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST_F(FieldViewTest, PixelsOfARobotLieWhereItsPoseSays) {
    const Pose pose{1.3, -0.7, 0.4};
    show(frameOfDiscs({pose}));
    for (const double zoom : {1.0, 2.3, 0.6})
        for (const double ratio : {1.0, 2.0, 1.5}) {
            view.viewport().fit();
            view.viewport().zoom(zoom);
            view.viewport().pan({-30, -20});
            const double scale = view.transform().scale() * ratio;
            const Blob blob = blobOf(rendered(view, ratio), bodyColour);
            const QPointF expected = ratio * pixelOf(position(pose));
            EXPECT_NEAR(blob.middle.x(), expected.x(), 0.7) << zoom << ' ' << ratio;
            EXPECT_NEAR(blob.middle.y(), expected.y(), 0.7) << zoom << ' ' << ratio;
            EXPECT_NEAR(std::sqrt(blob.pixels / std::numbers::pi), 0.3 * scale, 1.5) << zoom << ' ' << ratio;
        }
}

TEST_F(FieldViewTest, ArrowPointsWhereTheRobotFaces) {
    view.setLayers(only({FieldLayer::headings}));
    for (const double heading : {0.0, 90.0, 137.0, -60.0, 180.0}) {
        show(frameOfDiscs({{0.5, 0.2, heading * degree}}));
        view.viewport().fit();
        view.viewport().zoom(3);
        const Blob arrow = blobOf(rendered(view), QColor(255, 255, 255), 4);
        ASSERT_GT(arrow.pixels, 50);
        const QPointF along = arrow.middle - pixelOf({0.5, 0.2});
        EXPECT_NEAR(wrapAngle(std::atan2(-along.y(), along.x()) - heading * degree), 0, 3 * degree) << heading;
        // Its head is wider than its tail.
        const QImage image = rendered(view);
        const auto white = [&](double ahead) {
            const QPointF at =
                pixelOf({0.5 + ahead * std::cos(heading * degree), 0.2 + ahead * std::sin(heading * degree)});
            return blobOf(image.copy(QRect(at.toPoint() - QPoint(15, 15), QSize(31, 31))), QColor(255, 255, 255), 4)
                .pixels;
        };
        EXPECT_GT(white(0.2), 1.4 * white(-0.05)) << heading;
    }
}

TEST_F(FieldViewTest, ScreenOfTwoDevicePixelsAPixelIsDrawnAtItsFullResolution) {
    FieldFrame frame = frameOfDiscs({{1, 1, 1}, {-2, 0.5, -2}});
    show(frame);
    view.setLayers(only({FieldLayer::grid, FieldLayer::headings, FieldLayer::names}));
    const Theme theme = Theme::light();
    for (const double ratio : {2.0, 1.0, 2.0}) {  // the cached place is of the last one
        QImage direct(view.size() * ratio, QImage::Format_RGB32);
        direct.setDevicePixelRatio(ratio);
        QPainter painter(&direct);
        painter.setFont(view.font());
        FieldPainter field(painter, view.transform(), theme, view.layers());
        LabelPlacer labels;
        field.place(frame.scene().environment);
        FieldLegend legend;
        field.frame(frame, {}, labels, legend);
        field.corners(frame, legend);
        painter.end();
        EXPECT_EQ(differences(rendered(view, ratio), direct).size(), 0u) << ratio;
    }
}

TEST_F(FieldViewTest, WheelZoomsAtTheCursorAndFitShowsAll) {
    show(frameOfDiscs({{0, 0, 0}}));
    const double fitted = view.transform().scale();
    const QPointF cursor(123, 456);
    const Point before = view.transform().toMetres(cursor);
    wheel(cursor, 240);
    EXPECT_GT(view.transform().scale(), 1.2 * fitted);
    EXPECT_NEAR(view.transform().toMetres(cursor).x, before.x, 1e-9);
    EXPECT_NEAR(view.transform().toMetres(cursor).y, before.y, 1e-9);
    view.viewport().fit();
    EXPECT_DOUBLE_EQ(view.transform().scale(), fitted);
    for (const Point corner : {Point{-5, -4}, Point{5, 4}})
        EXPECT_TRUE(QRectF(view.rect()).contains(pixelOf(corner))) << corner.x;
    view.resize(400, 320);
    EXPECT_TRUE(QRectF(view.rect()).contains(pixelOf({5, 4}))) << "it stays fitted";
}

TEST_F(FieldViewTest, PartThatIsFittedStaysSoUntilTheUserLooksElsewhere) {
    show(frameOfDiscs({{0, 0, 0}}));
    const double whole = view.transform().scale();
    const auto expectPart = [&] {
        EXPECT_TRUE(view.viewport().showsPart());
        const QPointF least = pixelOf({1, 0}), most = pixelOf({2, 0.5});
        EXPECT_TRUE(QRectF(view.rect()).contains(least) && QRectF(view.rect()).contains(most));
        EXPECT_NEAR((least.x() + most.x()) / 2, view.width() / 2.0, 30) << "in the middle, but for rulers";
        EXPECT_GT(most.x() - least.x(), 0.8 * view.width()) << "as large as it can be";
    };
    view.viewport().fit({{1, 0}, {2, 0.5}});
    expectPart();
    view.resize(700, 560);
    expectPart();
    view.viewport().pan({5, 0});
    EXPECT_FALSE(view.viewport().showsPart());
    view.viewport().fit({{1, 0}, {2, 0.5}});
    view.viewport().zoom(2);
    EXPECT_FALSE(view.viewport().showsPart());
    view.resize(900, 560);
    view.viewport().fit({{1, 0}, {2, 0.5}});
    view.viewport().fit();
    EXPECT_FALSE(view.viewport().showsPart());
    view.resize(400, 320);
    EXPECT_TRUE(QRectF(view.rect()).contains(pixelOf({5, 4})));
    EXPECT_LT(view.transform().scale(), 2 * whole);
}

TEST_F(FieldViewTest, DraggedFloorGoesWithTheCursor) {
    show(frameOfDiscs({{0, 0, 0}}));
    const Point grabbed = view.transform().toMetres({200, 150});
    drag({200, 150}, {260, 120});
    EXPECT_NEAR(pixelOf(grabbed).x(), 260, 1e-9);
    EXPECT_NEAR(pixelOf(grabbed).y(), 120, 1e-9);
    EXPECT_TRUE(moved.empty());
}

TEST_F(FieldViewTest, FollowsTheSelectedBody) {
    show(frameOfDiscs({{0, 0, 0}, {2, 1, 0}}));
    view.setSelected(1);
    view.viewport().setFollowing(true);
    EXPECT_EQ(view.transform().centre(), (Point{2, 1}));
    auto later =
        std::make_shared<FieldFrame>(*std::make_shared<const FieldFrame>(frameOfDiscs({{0, 0, 0}, {2, 1, 0}})));
    later->state.robots[1].pose = {-1, 3, 0};
    view.setFrame(later);
    EXPECT_EQ(view.transform().centre(), (Point{-1, 3}));
    QSignalSpy spy(&view, &FieldView::followRequested);
    QTest::mouseDClick(&view, Qt::LeftButton, {}, pixelOf({0, 0}).toPoint());
    EXPECT_EQ(spy.count(), 1);
    EXPECT_EQ(view.selected(), 0u);
}

TEST_F(FieldViewTest, ClickSelectsTheUppermostBody) {
    show(frameOfDiscs({{0, 0, 0}, {0.2, 0, 0}}, {0.35, 0, 0}));
    const std::vector<std::pair<double, std::optional<std::size_t>>> at{{-0.2, 0}, {0.1, 1}, {0.35, 2}, {2, {}}};
    for (const auto& [x, body] : at) {
        QTest::mouseClick(&view, Qt::LeftButton, {}, pixelOf({x, 0}).toPoint());
        EXPECT_EQ(view.selected(), body) << x;
    }
}

TEST_F(FieldViewTest, DragMovesAndTurnsOnlyWhileTheRunStands) {
    show(frameOfDiscs({{1, 1, 0.5}}));
    const QPointF at = pixelOf({1.1, 1}), to = at + QPointF(80, 50);
    drag(at, to);
    EXPECT_TRUE(moved.empty());
    view.viewport().fit();
    view.setEditable(true);
    drag(at, to);
    ASSERT_EQ(moved.size(), 1u);
    const double scale = view.transform().scale();
    EXPECT_EQ(moved[0].first, 0u);
    EXPECT_NEAR(moved[0].second.x, 1 + 80 / scale, 1e-9);
    EXPECT_NEAR(moved[0].second.y, 1 - 50 / scale, 1e-9);
    EXPECT_EQ(moved[0].second.heading, 0.5);

    // Taken at its rim it turns along; in its middle it turns to the cursor.
    drag(pixelOf({1.25, 1}), pixelOf({1, 1.25}), Qt::RightButton);
    ASSERT_EQ(moved.size(), 2u);
    EXPECT_NEAR(wrapAngle(moved[1].second.heading - 0.5), 90 * degree, 1e-6);
    EXPECT_EQ(moved[1].second.x, 1);
    drag(pixelOf({1, 1}), pixelOf({1, 0}), Qt::RightButton);
    ASSERT_EQ(moved.size(), 3u);
    EXPECT_NEAR(wrapAngle(moved[2].second.heading), -90 * degree, 1e-6);
}

TEST_F(FieldViewTest, DragIsShownInNumbersAndEscapeTakesItBack) {
    show(frameOfDiscs({{1, 1, 0.5}, {-2, 0, 0}}));
    view.setEditable(true);
    const QImage before = rendered(view);
    press(pixelOf({1, 1}));
    moveTo(pixelOf({2, 1}));
    moveTo(pixelOf({2.5, 1}));
    const QImage during = rendered(view);
    const auto nearTarget = [&](const QPoint& p) { return QLineF(p, pixelOf({2.5, 1})).length() < 20; };
    const std::vector<QPoint> changed = differences(before, during);
    EXPECT_TRUE(std::any_of(changed.begin(), changed.end(), nearTarget)) << "a body where it would be put";
    QTest::keyClick(&view, Qt::Key_Escape);
    release(pixelOf({2.5, 1}));
    EXPECT_TRUE(moved.empty());

    // Who is made to run again meanwhile does not move.
    press(pixelOf({1, 1}));
    moveTo(pixelOf({2, 1}));
    view.setEditable(false);
    release(pixelOf({2, 1}));
    EXPECT_TRUE(moved.empty());
}

TEST_F(FieldViewTest, CtrlRoundsAndShiftMeasures) {
    show(frameOfDiscs({{1.03, 1.02, 0.5}}));
    view.setEditable(true);
    drag(pixelOf({1.03, 1.02}), pixelOf({2.04, 0.47}), Qt::LeftButton, Qt::ControlModifier);
    ASSERT_EQ(moved.size(), 1u);
    EXPECT_NEAR(moved[0].second.x, 2.0, 1e-9);
    EXPECT_NEAR(moved[0].second.y, 0.5, 1e-9);
    drag(pixelOf({1.03, 1.02}), pixelOf({1.03 + std::cos(0.8), 1.02 + std::sin(0.8)}), Qt::RightButton,
         Qt::ControlModifier);
    ASSERT_EQ(moved.size(), 2u);
    EXPECT_NEAR(moved[1].second.heading, 45 * degree, 1e-9);

    const ViewTransform before = view.transform();
    const QImage plain = rendered(view);
    press(pixelOf({-3, 0}), Qt::LeftButton, Qt::ShiftModifier);
    moveTo(pixelOf({0, 0}), Qt::LeftButton, Qt::ShiftModifier);
    const std::vector<QPoint> line = differences(plain, rendered(view));
    for (const double x : {-2.5, -1.0, -0.2})
        EXPECT_TRUE(std::find(line.begin(), line.end(), pixelOf({x, 0}).toPoint()) != line.end()) << x;
    release(pixelOf({0, 0}));
    EXPECT_TRUE(view.transform() == before);
    EXPECT_EQ(moved.size(), 2u);
}

TEST_F(FieldViewTest, KnobOfTheSelectedRobotTurnsIt) {
    FieldFrame frame = frameOfDiscs({{1, 1, 0.5}, {-2, 0, 0}});
    show(frame);
    view.setSelected(0);
    const QPointF knob = knobAt(view.transform(), frame, 0);
    const QPointF along = knob - pixelOf({1, 1});
    EXPECT_NEAR(std::atan2(-along.y(), along.x()), 0.5, 1e-9) << "before the robot";
    const QImage playing = rendered(view);
    view.setEditable(true);
    std::vector<QPoint> changed = differences(playing, rendered(view));
    EXPECT_GT(changed.size(), 40u);
    for (const QPoint& p : changed) EXPECT_LT(QLineF(p, knob).length(), 20);
    EXPECT_TRUE(view.readoutAt(knob).contains("turn robot 1"));
    const QPointF turned(along.y(), -along.x());  // a quarter, counter-clockwise
    drag(knob, pixelOf({1, 1}) + turned);
    ASSERT_EQ(moved.size(), 1u);
    EXPECT_EQ(moved[0].first, 0u);
    EXPECT_NEAR(wrapAngle(moved[0].second.heading - 0.5), 90 * degree, 1e-6);
    EXPECT_EQ(moved[0].second.x, 1);
    EXPECT_EQ(view.selected(), 0u);
    // A click there changes nothing, and while it plays there is none.
    QTest::mouseClick(&view, Qt::LeftButton, {}, knob.toPoint());
    EXPECT_EQ(view.selected(), 0u);
    view.setEditable(false);
    drag(knob, knob + QPointF(0, 60));
    EXPECT_EQ(moved.size(), 1u);
}

TEST_F(FieldViewTest, FittedPlaceStaysClearOfRulersAndScaleBar) {
    show(frameOfDiscs({{0, 0, 0}}));
    const auto place = [&] { return QRectF(pixelOf({-5, 4}), pixelOf({5, -4})); };
    EXPECT_LE(place().bottom(), 640 - 24) << "the scale bar";
    view.setLayers(only({FieldLayer::grid}));
    EXPECT_GE(place().left(), rulerWidth);
    EXPECT_GE(place().top(), rulerHeight);
    view.setLayers(FieldLayers::none());
    const double scale = view.transform().scale();
    EXPECT_EQ(view.viewport().fittedPlace(), place());
    const QRectF large(500, 400, 290, 230), small(700, 600, 90, 30);
    view.viewport().setCovered(large);
    EXPECT_EQ(view.transform().scale(), scale) << "what lies over a corner does not make it smaller";
    view.resize(1300, 640);
    for (const QRectF& card : {large.translated(500, 0), small.translated(500, 0)}) {
        view.viewport().setCovered(card);
        EXPECT_FALSE(place().intersects(card)) << "where there is room beside it";
        EXPECT_EQ(view.transform().scale(), scale);
        EXPECT_EQ(view.viewport().fittedPlace(), place());
    }
    view.viewport().zoom(3);
    const ViewTransform zoomed = view.transform();
    view.viewport().setCovered({});
    EXPECT_TRUE(view.transform() == zoomed) << "who has zoomed keeps what is seen";
}

TEST_F(FieldViewTest, LabelsStayClearOfWhatLiesOverTheView) {
    show(frameOfDiscs({{3, -2, 0}}));
    view.setLayers(only({FieldLayer::names}));
    const QRectF card(pixelOf({2, -2.35}), QSizeF(250, 60));
    const QImage before = rendered(view);
    view.setLayers(FieldLayers::none());
    const QImage none = rendered(view);
    const auto on = [&](const QImage& image) {
        const auto changed = differences(none, image);
        return std::count_if(changed.begin(), changed.end(), [&](const QPoint& p) { return card.contains(p); });
    };
    EXPECT_GT(on(before), 20);
    view.setLayers(only({FieldLayer::names}));
    view.viewport().setCovered(card);
    const QImage after = rendered(view);
    EXPECT_EQ(on(after), 0);
    EXPECT_GT(differences(none, after).size(), 50u) << "it is elsewhere";
}

/// Two places at which the same two touch: each number stays where it is while nothing moves.
TEST_F(FieldViewTest, NumbersOfTwoTouchesOfAPairDoNotChangePlaces) {
    FieldFrame frame = frameOfDiscs({{0, 0, 0}, {0.6, 0, 0}});
    frame.lastTick.contacts = {{0, 1, 0, {0.3, 0.08}, {1, 0}, 0.57}, {0, 1, 0, {0.3, -0.08}, {1, 0}, 0.06}};
    show(frame);
    view.setLayers(only({FieldLayer::contacts}));
    const QImage first = rendered(view);
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(differences(first, rendered(view)).empty()) << i;
}

TEST_F(FieldViewTest, NumbersOfTouchesAreReadOnFloorsAndLines) {
    FieldFrame frame = frameOfDiscs({{0, 0, 0}, {0.6, 0, 0}});
    frame.lastTick.contacts = {{0, 1, 0, {0.3, 0}, {1, 0}, 0.57}};
    Environment field;
    field.floor.colour = {0x3b, 0x7d, 0x4f};
    for (const Theme& theme : {Theme::light(), Theme::darkOne()}) {
        QImage image(10, 10, QImage::Format_RGB32);
        QPainter painter(&image);
        std::vector<FieldLabel> labels;
        drawContacts({painter, view.transform(), theme}, frame, {}, labels);
        ASSERT_EQ(labels.size(), 1u);
        for (const QColor& below : {floorColour(field, theme), QColor(Qt::white)}) {
            const QColor plate = mixed(below, theme.halo, theme.halo.alphaF());
            EXPECT_GE(contrast(labels[0].colour, plate), 4.5) << below.name().toStdString();
        }
    }
}

TEST_F(FieldViewTest, WhatAnAnswerIsAboutIsNearAndLoudAndTheRestIsQuiet) {
    FieldFrame frame = frameOfDiscs({{0, 0, 0}, {1.2, 1, 0}, {-1.2, 1, 0}}, {0.5, 0, 0});
    frame.lastTick.contacts = {
        {0, 3, 0, {0.35, 0}, {1, 0}, 0.5}, {0, 3, 0, {0.35, 0.05}, {1, 0}, 0.9}, {1, 2, 0, {0, 1.5}, {1, 0}, 3}};
    show(frame);
    view.setLayers(only({FieldLayer::contacts}));
    view.lightUp({0, 3});
    const double scale = view.transform().scale();
    EXPECT_GT(scale, 120);
    for (const Point& at : {Point{0, 0}, Point{0.5, 0}})
        EXPECT_TRUE(
            QRectF(view.rect()).adjusted(1.9 * scale, 1.9 * scale, -1.9 * scale, -1.9 * scale).contains(pixelOf(at)));
    // One number alone: that of the strongest touch of what is lit.
    const auto numbers = [&](const FieldFrame& of, bool lit) {
        FieldFocus focus;
        if (lit) focus.lit = {0, 3};
        QImage image(10, 10, QImage::Format_RGB32);
        QPainter painter(&image);
        std::vector<FieldLabel> labels;
        drawContacts({painter, view.transform(), Theme::light()}, of, focus, labels);
        QStringList texts;
        for (const FieldLabel& label : labels) texts << label.text;
        return texts.join('|').toStdString();
    };
    EXPECT_EQ(numbers(frame, true), "0.90 N s");
    EXPECT_EQ(numbers(frame, false), "0.50 N s|0.90 N s|3.00 N s");
    view.setLayers(only({FieldLayer::names}));
    const QImage lit = rendered(view);
    const ViewTransform near = view.transform();
    view.setEditable(false);  // it goes on
    EXPECT_TRUE(view.transform() == near);
    const auto changed = differences(lit, rendered(view));
    const auto nearBody = [&](const Point& at) {
        return std::count_if(changed.begin(), changed.end(),
                             [&](const QPoint& p) { return QLineF(p, pixelOf(at)).length() < 0.6 * near.scale(); });
    };
    EXPECT_GT(nearBody({1.2, 1}), 50) << "its name is loud again";
    EXPECT_EQ(nearBody({0, -0.2}), 0);
}

TEST_F(FieldViewTest, RingAndLineSayWhatIsElsewhereInTheOtherBranch) {
    show(frameOfDiscs({{0, 0, 0}, {-3, 2, 0}}));
    const QImage before = rendered(view);
    view.setElsewhere({Point{2, 0}, std::nullopt, std::nullopt});
    const auto changed = differences(before, rendered(view));
    EXPECT_GT(changed.size(), 100u);
    for (const QPoint& p : changed) {
        const Point at = view.transform().toMetres(QPointF(p) + QPointF(0.5, 0.5));
        const bool onRing = length(at) < 0.3 + 8 / view.transform().scale();
        const bool onLine = std::abs(at.y) < 4 / view.transform().scale() && at.x > 0 && at.x < 2.1;
        ASSERT_TRUE(onRing || onLine) << at.x << ' ' << at.y;
    }
}

/// Names that once gave way to others stand where they went; beside them a view that came later shows the same.
TEST_F(FieldViewTest, LabelsStandWhereThoseOfAnotherViewDo) {
    const FieldFrame crowd = frameOfDiscs({{0, 0, 0}, {0.7, 0.1, 0}, {0.1, 0.8, 0}, {0, -0.75, 0}});
    const FieldFrame apart = frameOfDiscs({{0, 0, 0}, {0.7, 0.1, 0}, {3, 3, 0}, {-3, 3, 0}});
    FieldView following, alone;
    QObject::connect(&view, &FieldView::labelsMoved, &following, &FieldView::followLabels);
    view.setLayers(only({FieldLayer::names}));
    show(crowd);
    (void)rendered(view);
    show(apart);
    const QImage image = rendered(view);
    for (FieldView* other : {&following, &alone}) {
        other->resize(view.size());
        other->setLayers(only({FieldLayer::names}));
        other->setFrame(std::make_shared<const FieldFrame>(apart));
    }
    EXPECT_FALSE(differences(image, rendered(alone)).empty());
    EXPECT_TRUE(differences(image, rendered(following)).empty());
}

TEST_F(FieldViewTest, WhatIsRoundHasNoHeading) {
    const FieldFrame frame = frameOfDiscs({{1, 1, 0.5}}, {2, 2, 0});
    EXPECT_TRUE(poseText(frame, 0, {1, 1, 0.5}).contains(QString::fromUtf8("\u00b0")));
    EXPECT_EQ(poseText(frame, 1, {2, 2, 0.5}), "x 2.00 m   y 2.00 m");
}

TEST_F(FieldViewTest, NotesOfOthersThanTheSelectedRobotAreFaint) {
    FieldFrame frame = frameOfDiscs({{-4, -3, 0}, {-4, 3, 0}});
    for (const std::size_t robot : {0u, 1u})
        frame.insights[robot].decision.annotations = {
            {Annotation::Kind::line, "way", 0, "", {{-2, robot * 2.0 - 1}, {3, robot * 2.0 - 1}}}};
    show(frame);
    const QImage nothing = rendered(view);
    view.setLayers(only({FieldLayer::targets}));
    const auto strength = [&](double y) {
        const QImage with = rendered(view);
        int most = 0;
        for (const QPoint& p : differences(nothing, with))
            if (std::abs(p.y() - pixelOf({0, y}).y()) < 6)
                most = std::max(most, std::abs(qGray(with.pixel(p)) - qGray(nothing.pixel(p))));
        return most;
    };
    view.setSelected(0);
    const int own = strength(-1), other = strength(1);
    EXPECT_GT(other, 3);
    EXPECT_GT(own, 2 * other);
    view.setSelected(1);
    EXPECT_GT(strength(1), 1.5 * other);
}

TEST_F(FieldViewTest, NudgeMovesTheSelectedBodyWhileTheRunStands) {
    show(frameOfDiscs({{1, 1, 0.5}}));
    view.setSelected(0);
    view.nudge({0.01, 0, 0});
    EXPECT_TRUE(moved.empty());
    view.setEditable(true);
    view.nudge({0.01, -0.02, 0.1});
    ASSERT_EQ(moved.size(), 1u);
    EXPECT_NEAR(moved[0].second.x, 1.01, 1e-12);
    EXPECT_NEAR(moved[0].second.y, 0.98, 1e-12);
    EXPECT_NEAR(moved[0].second.heading, 0.6, 1e-12);
}

}  // namespace
}  // namespace mrose
