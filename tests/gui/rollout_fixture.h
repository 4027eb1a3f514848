#pragma once

#include <QLabel>
#include <QStatusBar>
#include <string>
#include <vector>

#include "gui/overlay_fixture.h"
#include "widgets/field_view.h"

namespace mrose::gui {

/// Rollouts of 2 s of the shipped log, and breakpoints that look through all of them.
class RolloutTest : public OverlayTest {
protected:
    void SetUp() override {
        OverlayTest::SetUp();
        ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
        ASSERT_GE(overlay.rollouts().requests().size(), 8u);
    }

    void stopOn(const std::string& text) {
        Breakpoint breakpoint;
        breakpoint.text = text;
        window.session().setBreakpoints({breakpoint});
        settleAll();
    }
    void press(Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::keyClick(&window, Qt::Key_F6, modifiers);
        settleAll();
    }
    void open(std::size_t rollout) {
        ASSERT_TRUE(overlay.shown().show(rollout));
        settleAll();
        ASSERT_EQ(overlay.rollouts().shown(), rollout);
    }
    std::string said() const {
        QString all;
        for (const QLabel* label : window.statusBar()->findChildren<QLabel*>()) all += label->text() + '\n';
        return all.toStdString();
    }
    std::size_t shownRollout() const { return overlay.rollouts().shown().value(); }

    /// By 1 m, at an instant: a branch.
    void moveAside(double seconds) {
        window.session().seek(ticksOf(seconds));
        settleAll();
        Pose aside = state().robots[0].pose;
        aside.y += 1;
        emit window.field().bodyMoved(0, aside);
        settleAll();
    }
    std::int64_t ticksOf(double seconds) const { return window.shown()->frame->scene().ticksOf(fromSeconds(seconds)); }
};

}  // namespace mrose::gui
