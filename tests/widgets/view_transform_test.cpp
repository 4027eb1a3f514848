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

}  // namespace
}  // namespace mrose
