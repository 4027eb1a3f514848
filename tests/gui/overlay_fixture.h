#pragma once

#include <QApplication>
#include <QTest>
#include <QTreeView>
#include <functional>
#include <string>

#include "gui/file_fixture.h"
#include "logs/csv_writer.h"
#include "reality/overlay.h"
#include "reality/overlay_panel.h"
#include "support/places.h"
#include "synthetic/log_generator.h"

namespace mrose::gui {

/// A window with a log laid over its simulation.
class OverlayTest : public FileTest {
protected:
    OverlayTest() : overlay(window.overlay()), panel(window.overlayPanel()) {
        window.QWidget::show();
        window.resize(1280, 800);
    }

    static std::string shipped() { return (sourceFolder() / "resources" / "logs" / "pioneer" / "random.csv").string(); }

    void settleAll() {
        for (int i = 0; i < 3; ++i) {
            overlay.settle();
            window.session().settle();
            QApplication::processEvents();
        }
    }
    void openLog(const std::string& log) { openPlanned(log, {}); }
    void openLog(const std::string& log, const RolloutPlan& plan) { openPlanned(log, plan); }
    void openPlanned(const std::string& log, const std::optional<RolloutPlan>& plan) {
        const auto opened = overlay.openNow({log, ""}, plan);
        ASSERT_TRUE(opened) << opened.error().message();
        settleAll();
        ASSERT_NE(overlay.rollouts().comparison(), nullptr);
    }
    std::string refusal(const PlayedLogRequest& request, const std::optional<RolloutPlan>& plan = {}) {
        const auto opened = overlay.openNow(request, plan);
        return opened ? "" : opened.error().message();
    }
    void clickLine(int line) {
        QTreeView& list = panel.list();
        const QModelIndex index = list.model()->index(line, RolloutList::error);
        list.scrollTo(index);
        QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualRect(index).center());
        settleAll();
    }
    Reality reality() const { return *window.shown()->frame->reality; }

    /// A log that the shipped generator makes, of a jink, in the folder of the test.
    std::string makeLog(const std::function<void(Log&)>& change = {}) {
        std::optional<Log> log = generateLog({mrose::DrivePattern::jink, 2, -1, 1}, 5);
        if (change) change(*log);
        const std::string file = path("made.csv");
        EXPECT_TRUE(writeCsv(file, *log));
        return file;
    }

    Overlay& overlay;
    OverlayPanel& panel;
};

/// As `mrose compare` would do it.
inline Comparison comparedAlone(const Overlay& overlay) {
    ComparisonOptions options;
    options.seed = overlay.rollouts().log()->seed;
    auto comparison = compare(overlay.rollouts().world(), overlay.rollouts().requests(), options);
    EXPECT_TRUE(comparison) << comparison.error().message();
    return std::move(*comparison);
}

}  // namespace mrose::gui
