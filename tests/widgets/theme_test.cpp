// Colours are told apart by people with any colour vision.
#include "widgets/theme.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "widgets/field_drawing.h"

namespace mrose {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

Triple product(const Matrix& matrix, const Triple& v) {
    Triple result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) result[i] += matrix[i][j] * v[j];
    return result;
}

/// How linear light is seen without cones of one kind: Machado, Oliveira and Fernandes 2009, severity 1.
constexpr std::array<Matrix, 4> visions{
    {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
     {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
     {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}};

double linear(double channel) {
    return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

/// Lightness and two opponent colours of Oklab (Ottosson 2020).
Triple oklab(const Triple& light) {
    Triple cones = product({{{0.4122214708, 0.5363325363, 0.0514459929},
                             {0.2119034982, 0.6806995451, 0.1073969566},
                             {0.0883024619, 0.2817188376, 0.6299787005}}},
                           light);
    for (double& cone : cones) cone = std::cbrt(cone);
    return product({{{0.2104542553, 0.7936177850, -0.0040720468},
                     {1.9779984951, -2.4285922050, 0.4505937099},
                     {0.0259040371, 0.7827717662, -0.8086757660}}},
                   cones);
}

/// Between two colours for whom they are nearest; 100 between black and white.
double leastDistance(const QColor& a, const QColor& b) {
    double least = 100;
    for (const Matrix& vision : visions) {
        const auto seen = [&](const QColor& colour) {
            Triple light = product(vision, {linear(colour.redF()), linear(colour.greenF()), linear(colour.blueF())});
            for (double& part : light) part = std::clamp(part, 0.0, 1.0);
            return oklab(light);
        };
        const Triple one = seen(a), other = seen(b);
        least = std::min(least, 100 * std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]));
    }
    return least;
}

TEST(Theme, DistanceOfColoursIsThatOfTheEye) {
    EXPECT_NEAR(leastDistance(Qt::black, Qt::white), 100, 0.1);
    EXPECT_LT(leastDistance(QColor(180, 60, 60), QColor(101, 101, 60)), 12) << "red and olive, to who sees no red";
}

TEST(Theme, RobotsAreToldApartByWhateverColoursOneSees) {
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GT(leastDistance(robotColour(i), robotColour(j)), 7) << i << ' ' << j;
}

TEST(Theme, ColoursAreShadedUntilTheyAreSeen) {
    for (const QColor& ground : {QColor(Qt::white), Theme::darkOne().surround})
        for (std::size_t robot = 0; robot < 8; ++robot) {
            const QColor seen = seenOn(ground, robotColour(robot), 1.9);
            EXPECT_GE(contrast(seen, ground), 1.9) << robot;
            if (contrast(robotColour(robot), ground) >= 1.9) {
                EXPECT_EQ(seen, robotColour(robot));
            }
        }
}

TEST(Theme, RobotsAreToldFromAGreenFieldInBothThemes) {
    Environment field;
    field.floor.colour = {0x3b, 0x7d, 0x4f};
    for (const Theme& theme : {Theme::light(), Theme::darkOne()})
        for (std::size_t robot = 0; robot < 8; ++robot)
            EXPECT_GT(leastDistance(robotColour(robot), floorColour(field, theme)), 6) << robot << ' ' << theme.dark;
}

TEST(Theme, RobotsKeepTheirColoursWhereOthersAreLeftOut) {
    Scene scene;
    scene.robots.resize(3);
    scene.robots[1].place = 4;
    EXPECT_EQ(robotColour(scene, 0), robotColour(0));
    EXPECT_EQ(robotColour(scene, 1), robotColour(4));
    EXPECT_EQ(robotColour(scene, 2), robotColour(2));
}

}  // namespace
}  // namespace mrose
