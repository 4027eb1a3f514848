#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "control/controller.h"

namespace mrose {
namespace {

Decision fullOrders() {
    Decision decision;
    decision.command = Command{0.5, 0};
    decision.earlier = {{10, {0, 1}}, {20, {0.25, 0}}};
    decision.kicks = {{1, 0}};
    return decision;
}

/// What it takes to be other orders, a sign of a zero included.
TEST(Decision, OrdersDifferByAnyBit) {
    const std::function<void(Decision&)> changes[] = {
        [](Decision& d) { d.command->w = -0.0; },
        [](Decision& d) { d.command->v = std::nextafter(0.5, 1); },
        [](Decision& d) { d.command.reset(); },
        [](Decision& d) { d.earlier[0].command.v = -0.0; },
        [](Decision& d) { d.earlier[1].command.w = -0.0; },
        [](Decision& d) { d.earlier[1].time = 21; },
        [](Decision& d) { d.earlier.pop_back(); },
        [](Decision& d) { d.kicks[0].power = -0.0; },
        [](Decision& d) { d.kicks[0].manipulator = 0; },
        [](Decision& d) {
            d.kicks.push_back({1, 0});
        },
    };
    for (std::size_t i = 0; i < std::size(changes); ++i) {
        Decision changed = fullOrders();
        changes[i](changed);
        EXPECT_FALSE(changed.sameOrders(fullOrders())) << i;
        EXPECT_FALSE(fullOrders().sameOrders(changed)) << i;
    }
}

TEST(Decision, OrdersAreTheSameWhateverIsShown) {
    Decision shown = fullOrders();
    shown.annotations.push_back({Annotation::Kind::value, "distance", 1, "", {}});
    shown.breakHere();
    EXPECT_TRUE(shown.sameOrders(fullOrders()));
    EXPECT_TRUE(Decision().sameOrders({}));
    // What is no number equals itself, too: a controller that gives it again decides as before.
    Decision broken, again;
    broken.command = again.command = Command{std::nan(""), 0};
    EXPECT_TRUE(broken.sameOrders(again));
}

}  // namespace
}  // namespace mrose
