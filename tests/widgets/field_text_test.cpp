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
    view.zoom(1.4);
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

}  // namespace
}  // namespace mrose
