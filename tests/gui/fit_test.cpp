// Rules for every window: what stands in it is neither cut off nor over something else, at the sizes of small and large
// screens.
#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QStatusBar>
#include <QToolBar>

#include "frame/docks.h"
#include "frame/shrinking_area.h"
#include "gui/overlay_fixture.h"
#include "widgets/eliding_label.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

class FitTest : public OverlayTest {
protected:
    /// Of what stands in the window itself or scrolls in a panel: labels, buttons, inputs.
    std::vector<QWidget*> parts() {
        std::vector<QWidget*> parts;
        for (QWidget* widget : window.findChildren<QWidget*>()) {
            const bool shown = widget->isVisible() && !widget->visibleRegion().isEmpty() && widget->window() == &window;
            const bool text = qobject_cast<QLabel*>(widget) || qobject_cast<QAbstractButton*>(widget) ||
                              qobject_cast<QComboBox*>(widget) || qobject_cast<QLineEdit*>(widget);
            const bool own =
                widget->objectName().startsWith("qt_") || qobject_cast<QAbstractButton*>(widget->parentWidget());
            if (shown && text && !own) parts.push_back(widget);
        }
        return parts;
    }
    std::vector<const ShrinkingArea*> areas() {
        std::vector<const ShrinkingArea*> areas;
        for (const QDockWidget* dock : window.findChildren<QDockWidget*>())
            if (const auto* area = dynamic_cast<const ShrinkingArea*>(dock->widget());
                area != nullptr && !area->visibleRegion().isEmpty())
                areas.push_back(area);
        return areas;
    }
    static std::string nameOf(const QWidget* widget) {
        QString name = widget->metaObject()->className();
        if (const auto* label = qobject_cast<const QLabel*>(widget)) name += " \u201c" + label->text() + '"';
        if (const auto* button = qobject_cast<const QAbstractButton*>(widget)) name += " \u201c" + button->text() + '"';
        return (name + " in " + widget->parentWidget()->metaObject()->className()).toStdString();
    }
    static bool scrolls(const QWidget* widget) {
        for (const QWidget* above = widget; above != nullptr; above = above->parentWidget())
            if (qobject_cast<const QAbstractScrollArea*>(above)) return true;
        return false;
    }
    /// What of its text is not seen, pixels.
    static int missing(const QWidget* widget) {
        if (const auto* label = qobject_cast<const QLabel*>(widget)) {
            if (dynamic_cast<const ElidingLabel*>(label) != nullptr || label->text().isEmpty()) return 0;
            if (label->wordWrap()) return label->heightForWidth(label->width()) - label->height();
            return label->minimumSizeHint().width() - label->width();
        }
        if (qobject_cast<const QAbstractButton*>(widget)) return widget->minimumSizeHint().width() - widget->width();
        return 0;
    }
    void check(const char* view) {
        for (const QSize& size : {QSize(1024, 620), QSize(1280, 800), QSize(1920, 1080)}) {
            window.resize(size);
            settleAll();
            ASSERT_EQ(window.size(), size) << view;
            for (const ShrinkingArea* area : areas())
                EXPECT_EQ(area->horizontalScrollBar()->maximum(), 0)
                    << view << " at " << size.width() << ": " << area->parentWidget()->windowTitle().toStdString();
            const std::vector<QWidget*> all = parts();
            ASSERT_GT(all.size(), 15u);
            const std::string at = std::string(view) + " at " + std::to_string(size.width());
            for (std::size_t i = 0; i < all.size(); ++i) {
                EXPECT_LE(missing(all[i]), 0) << at << ": " << nameOf(all[i]);
                if (!scrolls(all[i])) {
                    EXPECT_EQ(all[i]->visibleRegion().boundingRect().size(), all[i]->size())
                        << at << ": " << nameOf(all[i]);
                }
                for (std::size_t j = 0; j < i; ++j) {
                    if (all[i]->parentWidget() != all[j]->parentWidget()) continue;
                    EXPECT_FALSE(all[i]->geometry().intersects(all[j]->geometry()))
                        << at << ": " << nameOf(all[i]) << " and " << nameOf(all[j]);
                }
            }
        }
    }
};

TEST_F(FitTest, GameWithItsPanels) {
    ASSERT_TRUE(window.files().openNow({"soccer.toml"}));
    settleAll();
    check("bare start");
    window.session().seek(200);
    settleAll();
    window.field().setSelected(2);
    window.frame().showDock("plots");
    check("inspector and plots");
    window.session().branchOff(moveBody(*window.shown()->frame, 2, {0, 1, 0}));
    settleAll();
    QTest::keyClick(&window, Qt::Key_S);
    settleAll();
    check("side by side");
}

TEST_F(FitTest, LogOverItsSimulation) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    check("log");
    overlay.models().add("velocity = command");
    clickLine(0);
    check("log, a robot and a model");
}

}  // namespace
}  // namespace mrose::gui
