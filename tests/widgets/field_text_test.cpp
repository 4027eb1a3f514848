// What a field view says and writes into files.
#include <QBuffer>
#include <QSvgGenerator>
#include <QSvgRenderer>
#include <numbers>

#include "debug/placement.h"
#include "widgets/field_drawing.h"
#include "widgets/field_fixture.h"
#include "widgets/field_readout.h"
#include "widgets/field_view_fixture.h"

namespace mrose {
namespace {

constexpr double oneDegree = std::numbers::pi / 180;

TEST_F(FieldViewTest, EmptyFieldSaysWhatToDo) {
    view.setFrame(nullptr);
    const QImage empty = rendered(view);
    view.setEmptyText("Drop a scenario here");
    EXPECT_GT(differences(empty, rendered(view)).size(), 100u);
}

TEST_F(FieldViewTest, FileShowsTheSameAsTheWindow) {
    const Pose pose{1.3, -0.7, 0.4};
    show(frameOfDiscs({pose}, {-2, 2, 0}));
    view.setLayers(only({FieldLayer::names}));
    view.viewport().zoom(1.4);
    QByteArray text;
    QBuffer buffer(&text);
    QSvgGenerator svg;
    svg.setOutputDevice(&buffer);
    svg.setSize(view.size());
    svg.setViewBox(view.rect());
    QPainter painter(&svg);
    view.paint(painter, view.size());
    painter.end();
    QImage image(view.size(), QImage::Format_RGB32);
    QPainter onImage(&image);
    QSvgRenderer(text).render(&onImage);
    onImage.end();
    const QImage window = rendered(view);
    for (const Colour& colour : {bodyColour, ballColour}) {
        const Blob inFile = blobOf(image, colour), inWindow = blobOf(window, colour);
        EXPECT_NEAR(inFile.middle.x(), inWindow.middle.x(), 0.5);
        EXPECT_NEAR(inFile.middle.y(), inWindow.middle.y(), 0.5);
        EXPECT_NEAR(inFile.pixels, inWindow.pixels, 0.05 * inWindow.pixels);
    }
}

TEST_F(FieldViewTest, TellsOfWhatItRestsOn) {
    FieldFrame frame = frameOfDiscs({{1, 1, 30 * oneDegree}, {-2, 0, 0}});
    frame.state.robots[0].velocity_B = {0.25, 0, -10 * oneDegree};
    frame.lastTick.contacts.push_back({0, 1, 0, {1.3, 1}, {1, 0}, 13.06});
    frame.insights[1].decision.annotations.push_back({Annotation::Kind::point, "aim", 0, "", {{3, -2}}});
    show(frame);
    const QString body = view.readoutAt(pixelOf({1, 1}));
    EXPECT_TRUE(body.contains("robot 1") && body.contains("30.0") && body.contains("0.25 m/s") &&
                body.contains("-10.0"))
        << body.toStdString();
    EXPECT_TRUE(view.readoutAt(pixelOf({1.3, 1})).contains("robot 1 on robot 2: 13.1 N s"));
    EXPECT_TRUE(view.readoutAt(pixelOf({3, -2})).contains("robot 2: aim"));
    EXPECT_EQ(noteText(frame, 1, {Annotation::Kind::point, "aim", 0, "", {}}), "aim");
    EXPECT_EQ(noteText(frame, 1, {Annotation::Kind::point, "ball", 0, "", {}}),
              QString::fromUtf8("robot 2\u2019s ball"));
    EXPECT_EQ(view.readoutAt(pixelOf({-4, -3})), QString());
    EXPECT_EQ(hindranceAt(frame, 0, {-1.5, 0, 0}), "on robot 2");
    EXPECT_EQ(hindranceAt(frame, 0, {-1.3, 0, 0}), "");
}

TEST_F(FieldViewTest, WhatAControllerMarksIsNotCovered) {
    FieldFrame frame = frameOfDiscs({{-3, -3, 0}}, {0.3, 0.3, 0});
    frame.insights[0].decision.annotations.push_back({Annotation::Kind::point, "ball", 0, "", {{0.3, 0.3}}});
    for (const double zoom : {1.0, 6.0}) {
        view.setLayers(only({}));
        show(frame);
        view.viewport().fit();
        view.viewport().zoom(zoom);
        const Blob alone = blobOf(rendered(view), ballColour);
        view.setLayers(only({FieldLayer::targets}));
        const Blob marked = blobOf(rendered(view), ballColour);
        EXPECT_GT(alone.pixels, 20);
        EXPECT_EQ(marked.pixels, alone.pixels) << zoom;
    }
    // Where nothing lies, the cross is in the middle.
    view.viewport().fit();
    frame.state.objects[0].pose = {3, 3, 0};
    show(frame);
    const QImage with = rendered(view);
    view.setLayers(only({}));
    EXPECT_GT(differences(rendered(view), with).size(), 20u);
}

TEST_F(FieldViewTest, NoNameStandsOnTheScaleBar) {
    view.resize(500, 300);
    view.setLayers(only({FieldLayer::names}));
    // From where the bar is to right of it.
    for (double x = -6; x < 0; x += 0.21) {
        view.setLayers(only({}));
        show(frameOfDiscs({{x, -3.75, 0}}));
        view.viewport().fit();
        const QImage without = rendered(view);
        view.setLayers(only({FieldLayer::names}));
        for (const QPoint& p : differences(without, rendered(view)))
            ASSERT_FALSE(QRect(14, view.height() - 18, 70, 12).contains(p)) << x << ": " << p.x() << ' ' << p.y();
    }
}

TEST_F(FieldViewTest, AKicksNumberStandsBesideTheRobotThatKicked) {
    FieldFrame frame = frameOfDiscs({{0, 0, 0}, {1.6, 0, 0}}, {0.5, 0, 0});
    ScenarioParts parts = frame.scenario->parts();
    Manipulator foot;
    foot.name = "foot";
    foot.position = {0.3, 0};
    parts.scene.robotTypes[0].manipulators = {foot};
    frame.scenario = std::make_shared<const Scenario>(std::move(parts));
    view.setLayers(only({}));
    show(frame);
    view.viewport().fit();
    const QImage without = rendered(view);
    StepTrace::Kicked kick;
    kick.robot = 0;
    kick.hit = true;
    kick.speed_W = {2, 0};
    frame.kicks = {kick};
    show(frame);
    const QImage with = rendered(view);
    double middle = 0, count = 0, coloured = 0;
    const QRgb chip = robotColour(frame.scene(), 0).rgb();
    for (const QPoint& p : differences(without, with)) {
        middle += view.transform().toMetres(p).x;
        ++count;
        coloured += with.pixel(p) == chip ? 1 : 0;
    }
    ASSERT_GT(count, 100);
    EXPECT_LT(middle / count, 0.8) << "nearer to the first";
    EXPECT_GT(coloured, 15) << "in its colour";
}

TEST_F(FieldViewTest, LegendLeavesALowFieldItsLargerPart) {
    show(frameOfDiscs({{0, 0, 0}}));
    for (const QSize& size : {QSize(460, 200), QSize(900, 600)}) {
        view.resize(size);
        view.setLayers(only({}));
        view.viewport().fit();
        const QImage without = rendered(view);
        FieldLayers all;
        all.set(FieldLayer::names, false);
        all.set(FieldLayer::legend, true);
        view.setLayers(all);
        const QImage with = rendered(view);
        all.set(FieldLayer::legend, false);
        view.setLayers(all);
        QRect box;
        for (const QPoint& p : differences(rendered(view), with)) box |= QRect(p, QSize(1, 1));
        ASSERT_FALSE(box.isEmpty());
        EXPECT_LE(box.height(), 0.65 * size.height()) << size.height();
        EXPECT_TRUE(QRect(QPoint(), size).adjusted(2, 2, -2, -2).contains(box)) << size.height();
    }
}

}  // namespace
}  // namespace mrose
