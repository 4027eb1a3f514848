#include "widgets/field_fixture.h"

#include <QPainter>

#include "support/scenes.h"
#include "widgets/field_legend.h"
#include "widgets/field_painter.h"

namespace mrose {
namespace {

std::shared_ptr<const Shape> coloured(double radius, const Colour& colour) {
    ShapePart part;
    part.name = "disc";
    part.radius = radius;
    part.colour = colour;
    return std::make_shared<const Shape>(Shape::fromParts("disc", {part}));
}

/// Stands still.
class Nothing final : public Controller {
public:
    void decide(const Observation& /*seen*/, std::span<std::byte> /*memory*/, Decision& decision) const override {
        decision.command = Command{};
    }
};

}  // namespace

FieldFrame frameOfDiscs(const std::vector<Pose>& robots, const Pose& ball) {
    ScenarioParts parts;
    parts.name = "discs";
    Scene& scene = parts.scene;
    scene.environment.floor.area = {{-5, -4}, {5, -4}, {5, 4}, {-5, 4}};
    RobotType type = discRobot(0.3);
    type.shape = coloured(0.3, bodyColour);
    scene.robotTypes = {type};
    scene.models = {paperFormModel()};
    ObjectType round = ballType();
    round.shape = coloured(0.1, ballColour);
    scene.objectTypes = {round};
    scene.objects = {{"ball", 0, ball, {}}};
    for (std::size_t i = 0; i < robots.size(); ++i) {
        SceneRobot robot;
        robot.name = "robot " + std::to_string(i + 1);
        robot.start = robots[i];
        scene.robots.push_back(robot);
        parts.controllers.push_back(std::make_shared<const Nothing>());
    }
    FieldFrame frame;
    frame.scenario = std::make_shared<const Scenario>(std::move(parts));
    frame.state = frame.scenario->initialState();
    frame.insights.resize(robots.size());
    return frame;
}

QImage paintedFrame(const FieldFrame& frame, const ViewTransform& view, const FieldLayers& layers,
                    const FieldFocus& focus) {
    QImage image(800, 640, QImage::Format_RGB32);
    image.fill(Qt::white);
    QPainter painter(&image);
    LabelPlacer labels;
    FieldLegend legend;
    const Theme theme = Theme::light();
    FieldPainter(painter, view, theme, layers).frame(frame, focus, labels, legend);
    return image;
}

FieldLayers only(std::initializer_list<FieldLayer> layers) {
    FieldLayers some = FieldLayers::none();
    for (const FieldLayer layer : layers) some.set(layer, true);
    return some;
}

QImage rendered(QWidget& widget, double ratio) {
    QImage image(widget.size() * ratio, QImage::Format_RGB32);
    image.setDevicePixelRatio(ratio);
    image.fill(Qt::black);
    widget.render(&image);
    return image;
}

Blob blobOf(const QImage& image, const QColor& colour, int near) {
    Blob blob;
    double x = 0, y = 0;
    for (int row = 0; row < image.height(); ++row)
        for (int column = 0; column < image.width(); ++column) {
            const QColor pixel = image.pixelColor(column, row);
            if (std::abs(pixel.red() - colour.red()) > near || std::abs(pixel.green() - colour.green()) > near ||
                std::abs(pixel.blue() - colour.blue()) > near)
                continue;
            ++blob.pixels;
            x += column + 0.5;
            y += row + 0.5;
        }
    if (blob.pixels > 0) blob.middle = {x / blob.pixels, y / blob.pixels};
    return blob;
}

std::vector<QPoint> differences(const QImage& a, const QImage& b) {
    std::vector<QPoint> points;
    for (int row = 0; row < a.height(); ++row)
        for (int column = 0; column < a.width(); ++column)
            if (a.pixel(column, row) != b.pixel(column, row)) points.emplace_back(column, row);
    return points;
}

}  // namespace mrose
