#include "widgets/view_transform.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(ViewTransform, WhatLiesAtTheCursorStaysThereWhileZooming) {
    ViewTransform view;
    view.setSize({640, 480});
    view.setCentre({1.5, -2});
    const QPointF cursor(100, 77);
    const Point before = view.toMetres(cursor);
    view.zoom(1.7, cursor);
    EXPECT_NEAR(view.toMetres(cursor).x, before.x, 1e-12);
    EXPECT_NEAR(view.toMetres(cursor).y, before.y, 1e-12);
}

/// Turned by a quarter, x points up and y to the left: headings, areas and ways of the picture turn with it.
TEST(ViewTransform, TurnedByAQuarterAllTurns) {
    ViewTransform view;
    view.setSize({640, 480});
    view.setTurned(true);
    view.fit({{-1, 2}, {5, 4}}, QRectF(100, 30, 400, 300));
    EXPECT_NEAR(view.scale(), 50, 1e-9) << "6 m in 300 pixels";
    const QRectF box = view.box({{-1, 2}, {5, 4}});
    EXPECT_NEAR(box.height(), 300, 1e-9);
    EXPECT_NEAR(box.width(), 100, 1e-9);
    EXPECT_NEAR(box.center().x(), 300, 1e-9);
    EXPECT_NEAR(box.center().y(), 180, 1e-9);
    const Point from{1, 3};
    const QPointF at = view.toPixels(from);
    EXPECT_NEAR(view.toMetres(at).x, from.x, 1e-12);
    EXPECT_NEAR(view.toMetres(at).y, from.y, 1e-12);
    for (const double heading : {0.0, 0.4, 2.5, -1.2}) {
        const QPointF to = view.toPixels(from + Point{std::cos(heading), std::sin(heading)});
        EXPECT_NEAR(view.along(heading).x(), (to - at).x() / 50, 1e-9);
        EXPECT_NEAR(view.along(heading).y(), (to - at).y() / 50, 1e-9);
    }
    const Point right = view.onField({1, 0});
    EXPECT_NEAR(view.toPixels(from + right).x(), at.x() + 50, 1e-9);
    EXPECT_NEAR(view.toPixels(from + right).y(), at.y(), 1e-9);
    const Area seen = view.shown();
    EXPECT_NEAR(seen.most.x - seen.least.x, 480 / 50.0, 1e-9);
    EXPECT_NEAR(seen.most.y - seen.least.y, 640 / 50.0, 1e-9);
}

TEST(ViewTransform, FitsIntoAPartOfThePicture) {
    ViewTransform view;
    view.setSize({640, 480});
    const QRectF into(100, 30, 400, 300);
    view.fit({{-1, 2}, {5, 4}}, into);
    const QPointF least = view.toPixels({-1, 2}), most = view.toPixels({5, 4});
    EXPECT_NEAR(least.x(), into.left(), 1e-9);
    EXPECT_NEAR(most.x(), into.right(), 1e-9);
    EXPECT_NEAR((least.y() + most.y()) / 2, into.center().y(), 1e-9);
}

}  // namespace
}  // namespace mrose
