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
