#include "widgets/field_drag.h"

#include <numbers>

#include <gtest/gtest.h>

namespace mrose {
namespace {

ViewTransform usualView() {
    ViewTransform view;
    view.setSize({640, 480});
    return view;
}

TEST(FieldDrag, ButtonAndPlaceSayWhatItIs) {
    using Kind = FieldDrag::Kind;
    FieldDrag left{Kind::pressed, Qt::LeftButton}, right{Kind::pressed, Qt::RightButton},
        middle{Kind::pressed, Qt::MiddleButton};
    EXPECT_EQ(left.dragged(true, true), Kind::move);
    EXPECT_EQ(right.dragged(true, true), Kind::turn);
    EXPECT_EQ(middle.dragged(true, true), Kind::pan);
    EXPECT_EQ(left.dragged(true, false), Kind::pan);
    EXPECT_EQ(left.dragged(false, true), Kind::pan);
    EXPECT_EQ(right.dragged(false, true), Kind::none);
    left.onKnob = true;
    EXPECT_EQ(left.dragged(true, true), Kind::turn);
}

TEST(FieldDrag, MovesByAsMuchAsTheMouseOrToRoundPlaces) {
    const ViewTransform view = usualView();
    const Pose pose{1.02, 0.51, 0.3};
    const FieldDrag drag{FieldDrag::Kind::move, Qt::LeftButton, view.toPixels({1, 0.5}), view.toPixels({1.35, 0.11})};
    const Pose free = drag.posed(pose, view, false), round = drag.posed(pose, view, true);
    EXPECT_NEAR(free.x, 1.37, 1e-9);
    EXPECT_NEAR(free.y, 0.12, 1e-9);
    EXPECT_EQ(free.heading, 0.3);
    EXPECT_NEAR(round.x, 1.4, 1e-9);
    EXPECT_NEAR(round.y, 0.1, 1e-9);
}

TEST(FieldDrag, TurnsAlongWithWhereItWasTakenOrFacesTheCursor) {
    const ViewTransform view = usualView();
    const Pose pose{0, 0, 0.3};
    FieldDrag drag{FieldDrag::Kind::turn, Qt::RightButton, view.toPixels({1, 0}), view.toPixels({0, 1})};
    EXPECT_NEAR(drag.posed(pose, view, false).heading, 0.3 + std::numbers::pi / 2, 1e-9);
    EXPECT_NEAR(drag.posed(pose, view, true).heading, 7 * std::numbers::pi / 12, 1e-9);
    drag.from = view.toPixels({0.01, 0});
    EXPECT_NEAR(drag.posed(pose, view, false).heading, std::numbers::pi / 2, 1e-9);
}

}  // namespace
}  // namespace mrose
