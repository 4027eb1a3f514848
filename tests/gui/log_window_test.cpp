// What a user meets who opens a real log for the first time: the window with its panels, plots, menus and dialogues.
#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QTest>
#include <QTreeWidget>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "actions/first_steps.h"
#include "export/plot_export.h"
#include "export/report_dialog.h"
#include "frame/quiet_message.h"
#include "frame/window_memory.h"
#include "gui/file_fixture.h"
#include "io/format.h"
#include "panels/log_dialog.h"
#include "panels/plot_panel.h"
#include "reality/error_plot.h"
#include "reality/overlay.h"
#include "reality/overlay_panel.h"
#include "scripting/window_script.h"
#include "session/background_work.h"
#include "support/places.h"
#include "widgets/field_view.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"
#include "workflow/open_model.h"
#include "workflow/resources.h"

namespace mrose::gui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class LogWindowTest : public FileTest {
protected:
    LogWindowTest() {
        window.resize(1280, 800);
        window.QWidget::show();
    }
    static std::string shipped() { return (sourceFolder() / "resources" / "logs" / "pioneer" / "random.csv").string(); }
    void settleAll() {
        for (int i = 0; i < 3; ++i) {
            window.overlay().settle();
            gui::settle(window.scripted());
        }
    }
    void openLog() {
        const auto opened = window.overlay().openNow({shipped(), ""});
        ASSERT_TRUE(opened) << opened.error().message();
        settleAll();
    }
    QDockWidget& dock(const char* name) { return *window.findChild<QDockWidget*>(name); }
    const PlotCurve& curve(const ValueKey& key) {
        const std::vector<ValueKey>& keys = window.plots().keys();
        const auto at = std::find(keys.begin(), keys.end(), key) - keys.begin();
        return window.plots().view().curves().at(static_cast<std::size_t>(at));
    }
    std::string robot() { return window.overlay().rollouts().world().robots().front().name; }
    const ComparedRollout& compared() {
        return window.overlay().rollouts().comparison()->rollouts.at(*window.overlay().rollouts().shown());
    }
};

TEST_F(LogWindowTest, EveryPanelFitsASmallScreen) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    for (QDockWidget* dock : window.findChildren<QDockWidget*>()) dock->show();
    QApplication::processEvents();
    EXPECT_LE(window.minimumSizeHint().width(), 1024);
    EXPECT_LE(window.minimumSizeHint().height(), 640);
    EXPECT_EQ(window.size(), QSize(1280, 800));
}

TEST_F(LogWindowTest, ErrorsOfTheWholeRolloutArePlottedUnasked) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    EXPECT_TRUE(dock("plots").isVisible());
    EXPECT_EQ(window.plots().keys(),
              (std::vector<ValueKey>{{positionErrorQuantity, robot()}, {headingErrorQuantity, robot()}}));
    const PlotView& view = window.plots().view();
    const Scene& scene = window.shown()->frame->scene();
    EXPECT_EQ(window.shown()->last, 0) << "nothing is simulated yet";
    EXPECT_EQ(view.axis().to(), static_cast<double>(scene.ticksOf(compared().real.steps() * WindowOptions{}.step)));
    const PlotCurve& position = curve({positionErrorQuantity, robot()});
    ASSERT_EQ(position.ahead.size(), static_cast<int>(compared().errors.position.size()));
    for (int k = 0; k < position.ahead.size(); ++k)
        EXPECT_EQ(position.ahead[k].y(), 100 * compared().errors.position[static_cast<std::size_t>(k)]) << k;
    EXPECT_TRUE(view.textAt(300).contains(fixedText(position.ahead[59].y(), position.decimals)));
    // Simulated, it is the same.
    seek(300);
    settleAll();
    EXPECT_NEAR(curve({positionErrorQuantity, robot()}).at(300), position.ahead[59].y(), 1e-4);
}

TEST_F(LogWindowTest, PlottedErrorsFollowRolloutAndModels) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    window.overlay().models().add("velocity = command");
    settleAll();
    ASSERT_EQ(window.plots().keys().size(), 4u);
    const ValueKey model{modelPositionErrorQuantity, robot(), "velocity = command"};
    const PlotCurve& added = curve(model);
    ASSERT_GT(added.ahead.size(), 400);
    const Reality& reality = *window.shown()->frame->reality;
    const auto last = static_cast<std::int64_t>(added.ahead.back().x());
    const auto error = reality.modelError(reality.models.front(), 0, window.shown()->frame->scene().timeOf(last));
    ASSERT_TRUE(error);
    EXPECT_EQ(added.ahead.back().y(), 100 * error->position);
    window.overlay().shown().show(1);
    settleAll();
    ASSERT_EQ(window.overlay().rollouts().shown(), 1u);
    EXPECT_EQ(window.plots().keys().size(), 4u);
    EXPECT_EQ(curve({positionErrorQuantity, robot()}).ahead.front().y(), 100 * compared().errors.position.front());
    window.overlay().models().remove(1);
    settleAll();
    EXPECT_EQ(window.plots().keys().size(), 2u);
    window.overlay().close();
    settleAll();
    EXPECT_TRUE(window.plots().keys().empty());
}

TEST_F(LogWindowTest, WhoRemovesTheErrorsDoesNotGetThemAgain) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    window.actions()["clear_plots"].trigger();
    window.overlay().shown().show(1);
    settleAll();
    EXPECT_TRUE(window.plots().keys().empty());
    window.actions()["plot_errors"].trigger();
    window.overlay().models().add("velocity = command");
    settleAll();
    EXPECT_EQ(window.plots().keys().size(), 4u) << "asked for again, they follow again";
}

TEST_F(LogWindowTest, WhoHasClosedThePlotsDoesNotGetThemAgain) {
    const auto settings = [&] { return std::make_unique<QSettings>(qPath("settings.ini"), QSettings::IniFormat); };
    window.frame().memory.restore(settings());
    ASSERT_NO_FATAL_FAILURE(openLog());
    ASSERT_TRUE(dock("plots").isVisible());
    dock("plots").close();
    window.overlay().shown().show(1);
    settleAll();
    EXPECT_FALSE(dock("plots").isVisible());
    MainWindow later;
    later.frame().memory.restore(settings());
    later.QWidget::show();
    ASSERT_TRUE(later.overlay().openNow({shipped(), ""}));
    later.overlay().settle();
    gui::settle(later.scripted());
    EXPECT_FALSE(later.findChild<QDockWidget*>("plots")->isVisible());
    later.actions()["plot_errors"].trigger();
    EXPECT_TRUE(later.findChild<QDockWidget*>("plots")->isVisible());
}

TEST_F(LogWindowTest, CurvesAreCalledByWhatDiffersAndAxesByTheirQuantity) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    window.overlay().models().add("velocity = command");
    settleAll();
    const QString own = qtText(window.overlay().models().all().front().name);
    const QString name = qtText(robot());
    EXPECT_EQ(window.plots().view().titles(),
              (QStringList{name + ": error (cm)", name + QString::fromUtf8(": heading_error (\u00b0)")}));
    auto* list = window.plots().findChild<QTreeWidget*>();
    // Under the name of its axis what is drawn in it.
    ASSERT_EQ(list->topLevelItemCount(), 8);
    for (int axis = 0; axis < 2; ++axis) {
        const QString named = axis == 0 ? "error (cm)" : QString::fromUtf8("heading_error (\u00b0)");
        const QStringList names{named, own, "velocity = command", "bound"};
        for (int i = 0; i < 4; ++i) EXPECT_EQ(list->topLevelItem(4 * axis + i)->text(0), names[i]);
    }
    // What is dashed is named, with its number at the shown instant.
    const DivergenceBound& bound = window.overlay().rollouts().shownRow()->bound;
    const DivergenceBound::At end = bound.bySteps.empty() ? bound.constant : bound.bySteps[99];
    seek(500);
    settleAll();
    EXPECT_EQ(list->topLevelItem(3)->text(1), fixedText(100 * end.position, 1));
    EXPECT_EQ(list->topLevelItem(7)->text(1), fixedText(degrees * end.heading, 1));
    list->setCurrentItem(list->topLevelItem(3));
    QTest::keyClick(list, Qt::Key_Delete);
    EXPECT_EQ(window.plots().keys().size(), 4u);
    EXPECT_GE(window.plots().view().width(), 0.6 * window.plots().width());
    EXPECT_EQ(window.plots().view().rangeOf(0).first, 0) << "no error is below zero";
    ASSERT_TRUE(window.plots().add({"error_ahead", robot()}));
    settleAll();
    EXPECT_EQ(window.plots().view().titles().front(), "cm") << "of several quantities";
}

TEST_F(LogWindowTest, PictureOfPlotsNamesLogRolloutModelsAndBound) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    window.overlay().setBound({{0.02, 0.05}, false});
    window.overlay().models().add("velocity = command");
    window.overlay().shown().show(2);
    settleAll();
    ASSERT_TRUE(window.overlay().rollouts().shownRow() != nullptr &&
                window.overlay().rollouts().shownRow()->divergence);
    ASSERT_TRUE(exportPlots(window.exports(), qPath("plots.svg")));
    window.background().settle();
    QApplication::processEvents();
    std::ifstream file(path("plots.svg"));
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string rollout = window.session().runName() + " for 10.0 s, " + robot();
    for (const std::string& part : {std::string("random.csv"), rollout, window.overlay().models().all().front().name,
                                    std::string("velocity = command"), std::string("bound"),
                                    std::string("leaves the logged trajectory"), std::string("error (cm)")})
        EXPECT_THAT(text, HasSubstr(part));
    const QString colour = markColour(TimelineMark::Kind::divergence, Theme::light()).name();
    EXPECT_GE(qtText(text).count(colour), 6) << "bound and mark of both axes and in the legend";
}

/// Against the comparison and its bound, wherever the run has come to.
TEST_F(LogWindowTest, TableOfPlotsGoesToTheEndOfTheRolloutAndHasTheBound) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    window.overlay().models().add("velocity = command");
    window.overlay().shown().show(2);
    settleAll();
    seek(100);
    settleAll();
    const auto expectTable = [&](const std::string& name) {
        ASSERT_TRUE(exportValues(window.exports(), qPath(name)));
        window.background().settle();
        QApplication::processEvents();
        std::ifstream file(path(name));
        std::vector<std::vector<std::string>> rows;
        for (std::string line; std::getline(file, line);) {
            rows.emplace_back();
            std::istringstream cells(line);
            for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
        }
        const ComparedRollout& rollout = compared();
        const RolloutRow& row = *window.overlay().rollouts().shownRow();
        ASSERT_TRUE(row.divergence);
        const Reality& reality = *window.shown()->frame->reality;
        const Scene& scene = window.shown()->frame->scene();
        constexpr int curves = 4;  // of position and heading, of the run and a model
        const std::vector<std::string> last(rows[0].begin() + 2 + curves, rows[0].end());
        EXPECT_THAT(last, ElementsAre("bound (cm)", "bound (\u00b0)", "leaves the logged trajectory", "ahead"));
        std::size_t compared = 0, crossings = 0;
        for (std::size_t i = 1; i < rows.size(); ++i) {
            const std::vector<std::string>& cells = rows[i];
            ASSERT_EQ(cells.size(), rows[0].size());
            const std::int64_t tick = std::stoll(cells[1]);
            EXPECT_EQ(cells.back(), tick > 100 ? "1" : "0");
            const bool leaves = scene.timeOf(tick) == row.divergence->time;
            EXPECT_EQ(cells[cells.size() - 2], leaves ? "1" : "0") << tick;
            crossings += leaves ? 1 : 0;
            if (tick < 5 || tick % 5 != 0) continue;
            const auto k = static_cast<std::size_t>(tick / 5 - 1);
            ++compared;
            EXPECT_NEAR(std::stod(cells[2]), 100 * rollout.errors.position[k], 1e-3) << tick;
            const auto error = reality.modelError(reality.models.front(), 0, scene.timeOf(tick));
            ASSERT_TRUE(error);
            EXPECT_NEAR(std::stod(cells[3]), 100 * error->position, 1e-3) << tick;
            const DivergenceBound::At at = row.bound.bySteps.empty() ? row.bound.constant : row.bound.bySteps[k];
            EXPECT_NEAR(std::stod(cells[2 + curves]), 100 * at.position, 1e-9) << tick;
            EXPECT_NEAR(std::stod(cells[3 + curves]), degrees * at.heading, 1e-9) << tick;
        }
        EXPECT_EQ(compared, rollout.errors.position.size()) << "each instant of the whole rollout";
        EXPECT_EQ(crossings, 1u);
    };
    window.overlay().setBound({{0.02, 0.05}, false});
    settleAll();
    expectTable("constant.csv");
    window.overlay().setBound({{0.02, 0.05}, true});
    settleAll();
    if (window.overlay().rollouts().shownRow()->divergence) expectTable("held_out.csv");
}

TEST_F(LogWindowTest, MenusOfferLogsWithoutOneBeingOpen) {
    const auto texts = [&](const char* menu) {
        QStringList names;
        for (const QAction* action : window.actions().menu(menu)->actions()) names << action->objectName();
        return names;
    };
    EXPECT_EQ(texts("&Reality").front(), "open_log");
    EXPECT_TRUE(window.actions()["open_log"].isEnabled());
    EXPECT_EQ(texts("&File").indexOf("open_log"), texts("&File").indexOf("open") + 1);
}

TEST_F(LogWindowTest, FirstStepsTellOfLogsAndGoAwayForThem) {
    window.actions()["first_steps"].setChecked(true);
    auto* card = window.findChild<FirstSteps*>();
    EXPECT_TRUE(std::any_of(card->steps().begin(), card->steps().end(),
                            [](const FirstSteps::Step& step) { return step.text.contains("real robots"); }));
    ASSERT_TRUE(card->isVisible());
    ASSERT_NO_FATAL_FAILURE(openLog());
    EXPECT_FALSE(card->isVisible() || card->folded());
    window.actions()["first_steps"].setChecked(true);
    window.overlay().shown().show(1);
    settleAll();
    EXPECT_TRUE(card->isVisible() || card->folded()) << "asked for, it stays";
}

TEST_F(LogWindowTest, FolderOfALogIsTakenWhereItIsTyped) {
    std::filesystem::create_directories(folder.path() / "MRCLAM_Dataset0");
    std::filesystem::create_directories(folder.path() / "other");
    for (const char* name : {"Robot1_Odometry.dat", "Robot1_Groundtruth.dat"})
        std::ofstream(folder.path() / "MRCLAM_Dataset0" / name) << "# nothing\n";
    const auto typed = [&](const QString& text) {
        LogDialog dialog(&window, "Open", qPath(""), "All files (*)");
        dialog.open();
        auto* line = dialog.findChild<QLineEdit*>("fileNameEdit");
        line->setText(text);
        QTest::keyClick(line, Qt::Key_Return);
        return dialog.result() == QDialog::Accepted ? dialog.chosen() : "still open";
    };
    EXPECT_EQ(typed(qPath("MRCLAM_Dataset0")), qPath("MRCLAM_Dataset0"));
    EXPECT_EQ(typed("MRCLAM_Dataset0"), qPath("MRCLAM_Dataset0"));
    EXPECT_EQ(typed(qPath("other")), "still open");
    EXPECT_EQ(typed(qPath("MRCLAM_Dataset0/Robot1_Odometry.dat")), qPath("MRCLAM_Dataset0/Robot1_Odometry.dat"));
}

TEST_F(LogWindowTest, ReportDialoguesSayWhatIsOpen) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    window.actions()["export_report"].trigger();
    auto* report = window.findChild<ReportDialog*>("report_dialog");
    ASSERT_NE(report, nullptr);
    const auto line = [](const ReportDialog& dialog, const char* name) {
        return dialog.findChild<QLineEdit*>(name)->text();
    };
    EXPECT_EQ(line(*report, "log").toStdString(), window.overlay().rollouts().log()->place);
    const std::filesystem::path network = line(*report, "network").toStdString();
    EXPECT_EQ(network.filename().string(), window.overlay().models().all().front().name);
    EXPECT_TRUE(std::filesystem::exists(network));
    report->close();
    RolloutPlan plan;
    plan.length = 5;
    ASSERT_TRUE(window.overlay().setPlan(plan));
    settleAll();
    window.actions()["export_comparison"].trigger();
    auto* comparison = window.findChild<ReportDialog*>("comparison_dialog");
    EXPECT_EQ(line(*comparison, "every"), "5");
    EXPECT_EQ(line(*comparison, "log").toStdString(), window.overlay().rollouts().log()->place);
    // What was written by hand stays.
    auto* every = comparison->findChild<QLineEdit*>("every");
    every->clear();
    QTest::keyClicks(every, "7");
    comparison->close();
    window.actions()["export_comparison"].trigger();
    EXPECT_EQ(every->text(), "7");
}

TEST_F(LogWindowTest, ResetLayoutKeepsRealityAndErrors) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    dock("plots").close();
    dock("inspector").close();
    window.actions()["reset_layout"].trigger();
    QApplication::processEvents();
    for (const char* name : {"reality", "plots", "inspector"}) EXPECT_TRUE(dock(name).isVisible()) << name;
    window.overlay().close();
    window.actions()["reset_layout"].trigger();
    EXPECT_FALSE(dock("reality").isVisible());
}

TEST_F(LogWindowTest, KeyOffersTheModelsThatShip) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    window.field().setFocus();
    QTest::keyClick(&window, Qt::Key_M, Qt::ControlModifier);
    auto* menu = window.findChild<QMenu*>("models_menu");
    ASSERT_NE(menu, nullptr);
    QStringList offered;
    for (const QAction* action : menu->actions()) offered << action->text();
    QStringList expected;
    for (const std::string& name : modelNames(*window.overlay().rollouts().log())) expected << qtText(name);
    expected << QString() << QString::fromUtf8("Other file\u2026");
    EXPECT_EQ(offered, expected);
    menu->actions().front()->trigger();
    menu->close();
    settleAll();
    ASSERT_EQ(window.overlay().models().all().size(), 2u);
    EXPECT_EQ(qtText(window.overlay().models().all().back().name), expected.front());
}

TEST_F(LogWindowTest, WhatIsSaidIsSeenOverTheField) {
    ASSERT_NO_FATAL_FAILURE(openLog());
    auto* quiet = window.findChild<QuietMessage*>();
    ASSERT_NE(quiet, nullptr);
    quiet->hide();
    window.overlay().setBound({{9, 3}, false});
    settleAll();
    window.actions()["go_to_divergence"].trigger();
    EXPECT_TRUE(quiet->isVisible());
    EXPECT_TRUE(quiet->text().contains("Nothing leaves")) << quiet->text().toStdString();
    EXPECT_TRUE(window.field().rect().contains(quiet->geometry()));
    window.frame().say("");
    EXPECT_FALSE(quiet->isVisible());
    window.actions().setUnattended(true);
    window.frame().say("nobody reads this");
    EXPECT_FALSE(quiet->isVisible()) << "pictures of a script are the same at any speed";
    window.actions().setUnattended(false);
}

}  // namespace
}  // namespace mrose::gui
