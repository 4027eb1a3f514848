#include "scenario/ball_contact.h"

#include <cmath>

#include <gtest/gtest.h>

namespace mrose {
namespace {

double contact(std::vector<ShapePart> parts, double radius = 0.11) {
    return ballContact(Shape::fromParts("s", std::move(parts)), radius);
}

TEST(BallContact, RoundRobotMeetsTheBallAtItsRadius) {
    EXPECT_NEAR(contact({{"", {}, {}, 0.225, {}}}), 0.225, 1e-6);
    EXPECT_NEAR(contact({{"", {}, {0.05, 0}, 0.225, {}}}), 0.275, 1e-6);
}

TEST(BallContact, FlatFrontMeetsItThereAndHornsBesideItDoNotMatter) {
    const ShapePart body{"", {{-0.2, -0.2}, {0.17, -0.2}, {0.17, 0.2}, {-0.2, 0.2}}, {}, 0, {}};
    const ShapePart left{"", {{0.1, 0.15}, {0.3, 0.15}, {0.3, 0.2}, {0.1, 0.2}}, {}, 0, {}};
    const ShapePart right{"", {{0.1, -0.2}, {0.3, -0.2}, {0.3, -0.15}, {0.1, -0.15}}, {}, 0, {}};
    EXPECT_NEAR(contact({body}), 0.17, 1e-6);
    EXPECT_NEAR(contact({body, left, right}), 0.17, 1e-6);
    // A ball wider than the gap of 0.3 m rests on the tips.
    EXPECT_NEAR(contact({body, left, right}, 0.2), 0.3 + std::sqrt(0.2 * 0.2 - 0.15 * 0.15) - 0.2, 1e-6);
}

TEST(BallContact, ShapeBehindItsReferencePointOrBesideItsWayHasNoFront) {
    EXPECT_LE(contact({{"", {}, {-0.5, 0}, 0.1, {}}}), 0);
    EXPECT_LE(contact({{"", {}, {0.5, 0.5}, 0.1, {}}}), 0);
}

}  // namespace
}  // namespace mrose
