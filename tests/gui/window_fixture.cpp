#include "gui/window_fixture.h"

#include <QApplication>
#include <QMouseEvent>

namespace mrose::gui {

void WindowTest::SetUp() {
    ASSERT_TRUE(window.open("soccer.toml"));
    window.QWidget::show();
    settle();
    ASSERT_NE(window.shown(), nullptr);
}

void WindowTest::settle() {
    window.session().settle();
    QApplication::processEvents();
}

void WindowTest::key(Qt::Key key, Qt::KeyboardModifiers modifiers) {
    QTest::keyClick(&window, key, modifiers);
    settle();
}

void WindowTest::drag(const QPointF& from, const QPointF& to, Qt::MouseButton button) {
    FieldView& field = window.field();
    const auto send = [&](QEvent::Type type, const QPointF& at, Qt::MouseButtons held) {
        QMouseEvent event(type, at, field.mapToGlobal(at.toPoint()), type == QEvent::MouseMove ? Qt::NoButton : button,
                          held, Qt::NoModifier);
        QApplication::sendEvent(&field, &event);
    };
    send(QEvent::MouseButtonPress, from, button);
    for (int i = 1; i <= 5; ++i) send(QEvent::MouseMove, from + (to - from) * i / 5.0, button);
    send(QEvent::MouseButtonRelease, to, Qt::NoButton);
    settle();
}

QPointF WindowTest::pixelOf(std::size_t body) const {
    const Pose& pose = window.shown()->frame->poseOf(body);
    return window.field().transform().toPixels({pose.x, pose.y});
}

}  // namespace mrose::gui
