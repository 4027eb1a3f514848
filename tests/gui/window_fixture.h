#pragma once

#include <QPoint>
#include <QTest>

#include <gtest/gtest.h>

#include "widgets/field_view.h"
#include "window/main_window.h"

namespace mrose::gui {

/// A window with the soccer scenario standing at its start, driven as a user does.
class WindowTest : public testing::Test {
protected:
    void SetUp() override;

    /// Waits until the session has carried out all that was asked for, and the window shows it.
    void settle();
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier);
    /// A press, some moves and a release on the field, in its pixels.
    void drag(const QPointF& from, const QPointF& to, Qt::MouseButton button = Qt::LeftButton);
    QPointF pixelOf(std::size_t body) const;
    const WorldState& state() const { return window.shown()->frame->state; }

    MainWindow window;
};

}  // namespace mrose::gui
