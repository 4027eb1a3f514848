#include "widgets/theme.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mrose {
namespace {

double luminance(const QColor& colour) {
    return 0.2126 * std::pow(colour.redF(), 2.2) + 0.7152 * std::pow(colour.greenF(), 2.2) +
           0.0722 * std::pow(colour.blueF(), 2.2);
}

}  // namespace

Theme Theme::light() {
    Theme t;
    t.surround = QColor(236, 238, 241);
    t.panel = QColor(250, 250, 251);
    t.text = QColor(32, 36, 42);
    t.quietText = QColor(96, 104, 116);
    t.line = QColor(198, 203, 211);
    t.accent = QColor(0, 102, 204);
    t.contact = QColor(200, 30, 90);
    t.kick = QColor(255, 255, 255);
    t.target = QColor(255, 255, 255);
    t.warning = QColor(176, 58, 0);
    t.onFloor = QColor(20, 22, 26);
    t.halo = QColor(255, 255, 255, 190);
    return t;
}

Theme Theme::darkOne() {
    Theme t = light();
    t.surround = QColor(24, 27, 31);
    t.panel = QColor(33, 36, 41);
    t.text = QColor(226, 229, 234);
    t.quietText = QColor(150, 158, 170);
    t.line = QColor(68, 74, 84);
    t.accent = QColor(86, 170, 255);
    t.contact = QColor(255, 92, 146);
    t.warning = QColor(255, 160, 90);
    t.onFloor = QColor(240, 242, 245);
    t.halo = QColor(10, 12, 14, 170);
    t.dark = true;
    return t;
}

QColor robotColour(std::size_t robot) {
    static const std::array<QColor, 8> colours{QColor(230, 159, 0),   QColor(86, 180, 233), QColor(240, 228, 66),
                                               QColor(204, 121, 167), QColor(218, 66, 0),   QColor(226, 238, 255),
                                               QColor(0, 126, 200),   QColor(94, 0, 120)};
    return colours[robot % colours.size()];
}

QColor robotColour(const Scene& scene, std::size_t robot) {
    return robotColour(robot < scene.robots.size() ? scene.placeOf(robot) : robot);
}

QColor modelColour(std::size_t model) {
    static const std::array<QColor, 4> colours{QColor(136, 34, 85), QColor(51, 34, 136), QColor(17, 119, 51),
                                               QColor(102, 60, 20)};
    return colours[model % colours.size()];
}

QVector<qreal> modelDashes(std::size_t model) {
    static const std::array<QVector<qreal>, 4> dashes{QVector<qreal>{}, {5, 3}, {1.5, 2.5}, {6, 2.5, 1.5, 2.5}};
    return dashes[model % dashes.size()];
}

Qt::PenStyle modelStyle(std::size_t model) {
    static constexpr std::array styles{Qt::SolidLine, Qt::DashLine, Qt::DotLine, Qt::DashDotLine};
    return styles[model % styles.size()];
}

QColor mixed(const QColor& one, const QColor& other, double share) {
    const auto between = [share](int a, int b) { return static_cast<int>(std::lround(a + share * (b - a))); };
    return {between(one.red(), other.red()), between(one.green(), other.green()), between(one.blue(), other.blue())};
}

double contrast(const QColor& a, const QColor& b) {
    const double more = std::max(luminance(a), luminance(b)), less = std::min(luminance(a), luminance(b));
    return (more + 0.05) / (less + 0.05);
}

QColor seenOn(const QColor& ground, QColor colour, double leastContrast) {
    const bool dark = setOff(ground) == QColor(255, 255, 255);
    for (int i = 0; i < 20 && contrast(colour, ground) < leastContrast; ++i)
        colour = dark ? colour.lighter(112) : colour.darker(112);
    return colour;
}

QColor setOff(const QColor& colour) {
    const QColor black(0, 0, 0), white(255, 255, 255);
    return contrast(colour, black) > contrast(colour, white) ? black : white;
}

}  // namespace mrose
