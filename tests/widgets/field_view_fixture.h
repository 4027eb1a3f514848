#pragma once

#include <QApplication>
#include <QMouseEvent>
#include <QWheelEvent>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "widgets/field_view.h"

namespace mrose {

/// A view of 800 x 640 pixels, driven by the mouse.
class FieldViewTest : public testing::Test {
protected:
    void SetUp() override {
        view.resize(800, 640);
        view.show();
        view.setLayers(FieldLayers::none());
        QObject::connect(&view, &FieldView::bodyMoved,
                         [this](std::size_t body, const Pose& pose) { moved.emplace_back(body, pose); });
    }
    void show(FieldFrame frame) { view.setFrame(std::make_shared<const FieldFrame>(std::move(frame))); }
    QPointF pixelOf(const Point& metres) const { return view.transform().toPixels(metres); }
    void send(QEvent::Type type, const QPointF& at, Qt::MouseButton button, Qt::KeyboardModifiers keys = {}) {
        QMouseEvent event(type, at, view.mapToGlobal(at.toPoint()), type == QEvent::MouseMove ? Qt::NoButton : button,
                          type == QEvent::MouseButtonRelease ? Qt::NoButton : button, keys);
        QApplication::sendEvent(&view, &event);
    }
    void press(const QPointF& at, Qt::MouseButton button = Qt::LeftButton, Qt::KeyboardModifiers keys = {}) {
        send(QEvent::MouseButtonPress, at, button, keys);
    }
    void moveTo(const QPointF& at, Qt::MouseButton button = Qt::LeftButton, Qt::KeyboardModifiers keys = {}) {
        send(QEvent::MouseMove, at, button, keys);
    }
    void release(const QPointF& at, Qt::MouseButton button = Qt::LeftButton) {
        send(QEvent::MouseButtonRelease, at, button);
    }
    void drag(const QPointF& from, const QPointF& to, Qt::MouseButton button = Qt::LeftButton,
              Qt::KeyboardModifiers keys = {}) {
        press(from, button, keys);
        moveTo((from + to) / 2, button, keys);
        moveTo(to, button, keys);
        release(to, button);
    }
    void wheel(const QPointF& at, int delta) {
        QWheelEvent event(at, view.mapToGlobal(at.toPoint()), {}, {0, delta}, Qt::NoButton, Qt::NoModifier,
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(&view, &event);
    }

    FieldView view;
    std::vector<std::pair<std::size_t, Pose>> moved;
};

}  // namespace mrose
