// Reports from within the window, beside those of `mrose`.
#include "export/report_export.h"

#include <QAction>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "export/report_dialog.h"
#include "gui/export_fixture.h"
#include "io/format.h"
#include "reality/overlay.h"
#include "scripting/window_script.h"
#include "session/background_work.h"
#include "support/places.h"
#include "support/run_program.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

class ReportExportTest : public ExportTest {
protected:
    static std::string shippedLog() { return (sourceFolder() / "resources/logs/pioneer").string(); }
    static std::string shippedNetwork() { return (sourceFolder() / "nets/pioneer.net").string(); }
    std::string place(const std::string& name) const { return path(name).toStdString(); }
    std::string run(const std::string& text) {
        const auto outcome = runScript(window.scripted(), text, "s.lua", {[](const auto&) {}, [](const auto&) {}});
        return outcome ? "" : outcome.error().message();
    }
    std::string scenario() const {
        folder.write("r.toml",
                     "format = \"mrose robot\"\nversion = 1\nname = \"r\"\nshape = \"pioneer1.toml\"\nmass_kg = 7\n"
                     "[motion]\nnetwork = \"pioneer.net\"\nrobot = \"reference\"\n");
        folder.write("e.toml",
                     "format = \"mrose environment\"\nversion = 1\nname = \"plane\"\n[floor]\n"
                     "area_m = [[-50, -50], [50, -50], [50, 50], [-50, 50]]\n");
        return folder
            .write("s.toml",
                   "format = \"mrose scenario\"\nversion = 1\nname = \"replay\"\nenvironment = \"e.toml\"\n"
                   "duration_s = 20\n[[robot]]\nname = \"twin\"\ntype = \"r.toml\"\n"
                   "controller = { kind = \"log_player\", log = \"x\", robot = \"reference\" }\n")
            .string();
    }
};

/// All files, to the last byte: the command that they tell is the same.
TEST_F(ReportExportTest, ReturnInALineWritesAndDoesNotClose) {
    ReportDialog* dialog = showReportDialog(window.exports());
    auto* line = dialog->findChild<QLineEdit*>("folder");
    line->setFocus();
    QTest::keyClick(line, Qt::Key_Return);
    EXPECT_TRUE(dialog->isVisible());
    EXPECT_THAT(dialog->findChild<QLabel*>("error")->text().toStdString(), HasSubstr("choose"));
}

TEST_F(ReportExportTest, IsTheOneOfMroseEvaluate) {
    ASSERT_EQ(runMrose({"evaluate", shippedNetwork(), "--log", shippedLog(), "--report", place("report")}).status, 0);
    std::filesystem::rename(folder.path() / "report", folder.path() / "theirs");
    EXPECT_EQ(run("export_report('" + shippedLog() + "', '" + shippedNetwork() + "', '" + place("report") + "')"), "");
    for (const char* file : {"report.html", "results.csv", "results.json", "windows.csv"}) {
        EXPECT_GT(read(std::string("report/") + file).size(), 100u) << file;
        EXPECT_TRUE(read(std::string("report/") + file) == read(std::string("theirs/") + file)) << file;
    }
}

TEST_F(ReportExportTest, IsTheOneOfMroseCompare) {
    const std::string scene = scenario();
    ASSERT_EQ(
        runMrose({"compare", scene, "--log", shippedLog(), "--every", "10.0", "--report", place("report")}).status, 0);
    std::filesystem::rename(folder.path() / "report", folder.path() / "theirs");
    EXPECT_EQ(run("export_comparison('" + scene + "', '" + shippedLog() + "', '" + place("report") + "', 10)"), "");
    for (const char* file : {"report.html", "errors.csv", "rollouts.csv", "results.json"}) {
        EXPECT_GT(read(std::string("report/") + file).size(), 100u) << file;
        EXPECT_TRUE(read(std::string("report/") + file) == read(std::string("theirs/") + file)) << file;
    }
}

TEST_F(ReportExportTest, WhatIsWrongIsOneLine) {
    folder.write("there/report.html", "an earlier one");
    const std::string log = "'" + shippedLog() + "'", network = "'" + shippedNetwork() + "'";
    EXPECT_THAT(run("export_report(" + log + ", " + network + ", '" + place("there") + "')"),
                HasSubstr("is there already; expected another folder"));
    EXPECT_THAT(run("export_report(" + log + ", '" + place("no.net") + "', '" + place("new") + "')"),
                HasSubstr("no.net: cannot be read"));
    EXPECT_THAT(run("export_report('" + place("no.csv") + "', " + network + ", '" + place("new") + "')"),
                HasSubstr("no.csv"));
    EXPECT_THAT(run("export_report(" + log + ")"), HasSubstr("expected a log, a network and a folder"));
    EXPECT_THAT(run("export_comparison('soccer.toml', " + log + ", '" + place("new") + "')"), HasSubstr("soccer"));
    EXPECT_EQ(files(), std::vector<std::string>{"there"});
    EXPECT_EQ(read("there/report.html"), "an earlier one");
}

TEST_F(ReportExportTest, CancelledOneLeavesNothing) {
    ASSERT_TRUE(exportReport(window.exports(), {shippedNetwork(), shippedLog()}, path("report")));
    window.actions()["cancel"].trigger();
    finish();
    EXPECT_THAT(said(), testing::ElementsAre("Not exported: cancelled"));
    EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(ReportExportTest, WhatIsMissingIsLegibleInBothThemes) {
    for (const bool dark : {false, true}) {
        if (window.actions()["dark"].isChecked() != dark) window.actions()["dark"].trigger();
        ReportDialog* const dialog = showReportDialog(window.exports());
        dialog->findChild<QLineEdit*>("network")->clear();
        dialog->start();
        auto* said = dialog->findChild<QLabel*>("error");
        ASSERT_FALSE(said->text().isEmpty());
        said->ensurePolished();
        EXPECT_GE(contrast(said->palette().color(QPalette::WindowText), dialog->palette().color(QPalette::Window)), 4.5)
            << dark;
    }
}

TEST_F(ReportExportTest, DialogueAsksForWhatItTakes) {
    window.actions()["export_report"].trigger();
    auto* dialog = window.findChild<ReportDialog*>("report_dialog");
    ASSERT_NE(dialog, nullptr);
    EXPECT_TRUE(dialog->isVisible());
    const auto says = [&](const char* text) {
        for (const QLabel* label : dialog->findChildren<QLabel*>())
            if (label->text().contains(text)) return true;
        return false;
    };
    dialog->start();
    EXPECT_TRUE(says("choose a log first"));
    dialog->findChild<QLineEdit*>("log")->setText(qtText(shippedLog()));
    dialog->findChild<QLineEdit*>("network")->setText(qtText(shippedNetwork()));
    dialog->findChild<QLineEdit*>("folder")->setText(path("report"));
    dialog->start();
    EXPECT_FALSE(dialog->isVisible());
    finish();
    EXPECT_TRUE(isThere("report/report.html"));
    ASSERT_EQ(said().size(), 1u);
    EXPECT_THAT(said()[0], HasSubstr("report.html"));
    EXPECT_EQ(window.messages().messages()[0].buttons[0].text, "Open");
}

/// A window with a log over its simulation: what it shows is what its dialogue offers.
class ComparisonDialogTest : public ReportExportTest {
protected:
    void open(const PlayedLogRequest& request, const std::optional<RolloutPlan>& plan = {}) {
        const auto opened = overlay.openNow(request, plan);
        ASSERT_TRUE(opened) << opened.error().message();
        settleOverlay();
    }
    void settleOverlay() {
        for (int i = 0; i < 3; ++i) {
            overlay.settle();
            settle();
        }
    }
    /// By the dialogue as it is offered, to the last byte beside that of the program.
    void expectTheOneOf(std::vector<std::string> words) {
        for (const char* made : {"report", "theirs"}) std::filesystem::remove_all(place(made));
        words.insert(words.end(), {"--report", place("report"), "--quiet"});
        const ProgramResult ran = runMrose(words);
        ASSERT_EQ(ran.status, 0) << ran.err;
        std::filesystem::rename(place("report"), place("theirs"));
        window.actions()["export_comparison"].trigger();
        auto* dialog = window.findChild<ReportDialog*>("comparison_dialog");
        dialog->findChild<QLineEdit*>("folder")->setText(path("report"));
        dialog->start();
        EXPECT_FALSE(dialog->isVisible()) << dialog->findChild<QLabel*>("error")->text().toStdString();
        finish();
        ASSERT_TRUE(isThere("report/results.json"));
        for (const char* file : {"errors.csv", "rollouts.csv", "report.html", "results.json"}) {
            // All but the words of the command.
            std::string ours = read(std::string("report/") + file), theirs = read(std::string("theirs/") + file);
            const std::size_t at = theirs.find(" --quiet");
            if (at != std::string::npos) theirs.erase(at, std::string(" --quiet").size());
            EXPECT_TRUE(ours == theirs) << file;
        }
    }
    /// Those of the report against those of the window's list.
    void expectTheWindowsDivergences() {
        const auto json = nlohmann::json::parse(read("report/results.json"));
        std::size_t leaving = 0;
        for (const RolloutRow& row : overlay.rollouts().rows()) leaving += row.divergence ? 1 : 0;
        EXPECT_GT(leaving, 0u);
        EXPECT_EQ(json["divergence"]["all"]["diverging"], leaving) << json["divergence"].dump();
    }

    Overlay& overlay = window.overlay();
};

TEST_F(ComparisonDialogTest, TakesOverStartLengthBoundAndModels) {
    const std::string log = shippedLog() + "/random.csv", other = place("other.net");
    std::filesystem::copy_file(sourceFolder() / "nets/create.net", other);
    ASSERT_NO_FATAL_FAILURE(open({log, ""}, RolloutPlan{RolloutPlan::Cut::every, 1.5, 4, 20.0}));
    overlay.models().add(other);
    overlay.setBound({{0.005, 7 / degrees}, false});
    settleOverlay();
    expectTheOneOf({"compare", "--log", log, "--start", "1.5", "--duration", "20.0", "--every", "4.0",
                    "--bound-position", "0.005", "--bound-heading", "7.0", "--model", other});
    expectTheWindowsDivergences();
    overlay.setBound({{}, true});
    ASSERT_TRUE(overlay.setPlan({RolloutPlan::Cut::once, 0, 8}));
    settleOverlay();
    expectTheOneOf({"compare", "--log", log, "--duration", "8.0", "--model", other});
}

TEST_F(ComparisonDialogTest, TakesOverWindowsAndWhatDrove) {
    const std::string log = place("own.csv");
    std::filesystem::copy_file(shippedLog() + "/random.csv", log);
    PlayedLogRequest request{log, ""};
    request.robotFile = "pioneer1.toml";
    request.seed = 7;
    ASSERT_NO_FATAL_FAILURE(open(request, RolloutPlan{RolloutPlan::Cut::windows, 0, 5}));
    expectTheOneOf(
        {"compare", "--log", log, "--robot", "pioneer1.toml", "--duration", "5.0", "--windows", "all", "--seed", "7"});
    const auto json = nlohmann::json::parse(read("report/results.json"));
    EXPECT_EQ(json["all"]["rollouts"], overlay.rollouts().rows().size());
}

TEST_F(ComparisonDialogTest, NumbersThatMakeNoSenseAreSaidAndNothingIsWritten) {
    ASSERT_NO_FATAL_FAILURE(open({shippedLog() + "/random.csv", ""}));
    window.actions()["export_comparison"].trigger();
    auto* dialog = window.findChild<ReportDialog*>("comparison_dialog");
    dialog->findChild<QLineEdit*>("folder")->setText(path("report"));
    const auto said = [&](const char* name, const char* text) {
        auto* line = dialog->findChild<QLineEdit*>(name);
        const QString before = line->text();
        line->setText(text);
        dialog->start();
        line->setText(before);
        return dialog->findChild<QLabel*>("error")->text().toStdString();
    };
    EXPECT_THAT(said("every", "often"), HasSubstr("\"often\" makes no sense"));
    EXPECT_THAT(said("start", "-1"), HasSubstr("from 0"));
    EXPECT_THAT(said("heading", "200"), HasSubstr("to 180"));
    EXPECT_THAT(said("windows", "all"), HasSubstr("windows begin where they are"));
    dialog->findChild<QLineEdit*>("scenario")->setText("soccer.toml");
    EXPECT_THAT(said("robot", "pioneer1.toml"), HasSubstr("leave out the robot file"));
    EXPECT_FALSE(isThere("report"));
}

}  // namespace
}  // namespace mrose::gui
