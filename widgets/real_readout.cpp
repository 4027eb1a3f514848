#include "widgets/real_readout.h"

#include <QObject>
#include <QStringList>
#include <numbers>

#include "widgets/field_readout.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

QString degreesText(double radians) {
    return QString::number(radians * 180 / std::numbers::pi, 'f', 1) + QString::fromUtf8("\u00b0");
}

}  // namespace

QColor realColour(std::optional<std::size_t> place, const Theme& theme) {
    return place ? mixed(robotColour(*place), theme.onFloor, 0.6) : mixed(theme.quietText, theme.onFloor, 0.3);
}

QString errorText(const PoseError& error) { return lengthText(error.position) + ", " + degreesText(error.heading); }

QString realReadout(const FieldFrame& frame, const RealRobot& robot) {
    const QString name = QObject::tr("%1 %2").arg(realWord(frame), qtText(frame.reality->robots[robot.index].name));
    if (robot.lostFor)
        return QObject::tr("%1: no ground truth for %2 s").arg(name).arg(toSeconds(*robot.lostFor), 0, 'f', 1);
    if (robot.apart) return QObject::tr("%1: %2 away").arg(name, errorText(*robot.apart));
    return name + '\n' + poseText(robot.pose);
}

QString realReadout(const FieldFrame& frame, std::optional<std::size_t> body, const Point& at) {
    QStringList lines;
    for (const RealRobot& robot : realRobots(frame))
        if (body ? robot.body == body : distance(position(robot.pose), at) <= robot.shape->reach)
            lines += realReadout(frame, robot);
    return lines.join('\n');
}

QString modelReadout(const FieldFrame& frame, std::size_t body) {
    const auto real = realRobotOf(frame, body);
    if (!real) return {};
    QStringList lines;
    for (const Reality::ModelRollout& model : frame.reality->models)
        if (const auto error = frame.reality->modelError(model, real->index, frame.now()))
            lines += QObject::tr("%1: %2 away").arg(qtText(model.name), errorText(*error));
    return lines.join('\n');
}

}  // namespace mrose
