// What the panel of a log says, and how its lists are looked at.
#include <QAbstractButton>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QScrollBar>
#include <QStyle>
#include <QTextLayout>
#include <QTreeWidget>
#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "gui/overlay_fixture.h"
#include "widgets/eliding_text.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"
#include "workflow/open_model.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

class OverlayPanelTest : public OverlayTest {
protected:
    QTreeView& list() { return panel.list(); }
};

TEST_F(OverlayPanelTest, SaysWhoseFiguresOfTheModelsAreShown) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    auto* whose = panel.findChild<QComboBox*>("figures");
    ASSERT_NE(whose, nullptr);
    const auto& [compared, evaluated] = overlay.models().all().front().figures;
    ASSERT_TRUE(compared && *compared && evaluated && *evaluated);
    const QString with = fixedText((*compared)->counted.p, 2), open = fixedText((*evaluated)->p, 2);
    ASSERT_NE(with, open);
    EXPECT_EQ(whose->currentText(), "with contacts");
    EXPECT_EQ(panel.models().topLevelItem(0)->text(1), with);
    const QString both = panel.models().topLevelItem(0)->toolTip(1);
    EXPECT_TRUE(both.contains("P " + with) && both.contains("P " + open)) << both.toStdString();
    whose->setCurrentIndex(1);
    EXPECT_EQ(whose->currentText(), "without contacts");
    EXPECT_EQ(panel.models().topLevelItem(0)->text(1), open);
}

/// A verdict does not take back what it says, and all of it is seen; terms of the reports are for tool tips.
TEST_F(OverlayPanelTest, VerdictIsWholeAndInPlainWords) {
    // No robot that is pushed to and fro all the time is explained by anything that is asked.
    const std::string swaying = makeLog([](Log& log) {
        for (StampedPose& stamped : log.robots[0].trajectories[0].poses)
            stamped.pose.y += 0.05 * std::sin(5 * toSeconds(stamped.time));
    });
    for (const bool explained : {true, false}) {
        ASSERT_NO_FATAL_FAILURE(openLog(explained ? shipped() : swaying, {RolloutPlan::Cut::every, 0, 2}));
        overlay.setBound({{0.01, 0.05}, false});
        settleAll();
        std::size_t likely = 0, none = 0;
        for (int line = 0; line < 2; ++line) {
            clickLine(line);
            if (!overlay.causes().finding() || !overlay.causes().finding()->diagnosis) continue;
            const Diagnosis& diagnosis = *overlay.causes().finding()->diagnosis;
            const std::string text = panel.causes().text().toStdString();
            ++(diagnosis.likely ? likely : none);
            EXPECT_EQ(text.find("Likely cause") != std::string::npos, diagnosis.likely.has_value()) << text;
            EXPECT_EQ(text.find("No likely cause") != std::string::npos, !diagnosis.likely) << text;
            for (const ElidingText* part : panel.causes().findChildren<ElidingText*>())
                EXPECT_FALSE(part->shownText().contains(QChar(0x2026))) << part->text().toStdString();
        }
        EXPECT_GT(explained ? likely : none, 0u);
    }
    QStringList words;
    for (const QLabel* label : panel.findChildren<QLabel*>()) words << label->text();
    for (const QAbstractButton* button : panel.findChildren<QAbstractButton*>()) words << button->text();
    for (int column = 0; column < 5; ++column) words << panel.models().headerItem()->text(column);
    for (const char* const term : {"P %", "Hd", "held out", "evaluate", "none of these"})
        EXPECT_FALSE(words.join('\n').contains(term)) << term;
}

/// What is greyed would be taken for what counts.
TEST_F(OverlayPanelTest, BoundThatIsShownIsTheOneInForce) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 5}));
    ASSERT_TRUE(overlay.rollouts().bound().fromNetwork);
    const DivergenceBound& bound = overlay.rollouts().shownRow()->bound;
    ASSERT_FALSE(bound.bySteps.empty());
    const auto shown = [&] {
        QString all;
        for (const QLabel* label : panel.causes().findChildren<QLabel*>())
            if (label->isVisible()) all += label->text() + '\n';
        for (const QDoubleSpinBox* box : panel.causes().findChildren<QDoubleSpinBox*>())
            if (box->isVisible()) all += box->text() + '\n';
        return all.toStdString();
    };
    const std::string end = fixedText(100 * bound.bySteps.back().position, 1).toStdString() + " cm, ";
    EXPECT_THAT(shown(), HasSubstr(end));
    EXPECT_THAT(shown(), testing::Not(HasSubstr("10.0 cm")));
    overlay.setBound({{0.02, 0.05}, false});
    settleAll();
    EXPECT_THAT(shown(), HasSubstr("2.0 cm"));
    EXPECT_THAT(shown(), testing::Not(HasSubstr(end)));
}

/// Whoever sees a robot move does not read that it stands.
TEST_F(OverlayPanelTest, SaysWhatIsLeftOutAndWhy) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 1}));
    const ComparedSummary& all = overlay.rollouts().comparison()->all;
    const RolloutList& rollouts = *panel.rollouts();
    std::size_t little = 0;
    for (int line = 0; line < rollouts.rowCount(); ++line) {
        const RolloutRow& row = rollouts.row(line);
        if (row.use != RolloutUse::still) continue;
        ++little;
        EXPECT_EQ(rollouts.text(row, RolloutList::drives), "moves little");
        const QString tip = rollouts.index(line, RolloutList::drives).data(Qt::ToolTipRole).toString();
        EXPECT_TRUE(tip.contains(fixedText(100 * row.path, 0) + " cm")) << tip.toStdString();
        EXPECT_TRUE(tip.contains("less than 3 cm and 6")) << "of 30 cm and 57 degrees in 10 s: " << tip.toStdString();
    }
    ASSERT_GT(little, 0u) << "a log in which it hardly moves somewhere";
    QStringList words;
    for (const QLabel* label : panel.findChildren<QLabel*>()) words << label->text();
    const std::string said = words.join('\n').toStdString();
    EXPECT_THAT(said, HasSubstr(std::to_string(all.of(RolloutUse::counted)) + " of " + std::to_string(all.rollouts()) +
                                " count"));
    EXPECT_THAT(said, HasSubstr(std::to_string(little) + " move little"));
    for (int column = 1; column < 5; ++column)
        EXPECT_FALSE(panel.models().headerItem()->text(column).contains("way")) << "a path is a path";
    EXPECT_TRUE(panel.models().headerItem()->text(3).contains("median"));
}

TEST_F(OverlayPanelTest, WhereThereIsLittleRoomTheLessImportantColumnsAreLeftOut) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    const auto shown = [&] {
        std::set<int> columns;
        for (int column = 0; column < RolloutList::columns; ++column)
            if (!list().isColumnHidden(column)) columns.insert(column);
        return columns;
    };
    list().setFixedWidth(600);
    settleAll();
    const std::set<int> all = shown();
    EXPECT_TRUE(all.count(RolloutList::path) == 1 && all.count(RolloutList::drives) == 1);
    list().setFixedWidth(240);
    settleAll();
    for (const int column : {RolloutList::start, RolloutList::error}) EXPECT_EQ(shown().count(column), 1u);
    EXPECT_LT(shown().size(), all.size());
    EXPECT_EQ(list().horizontalScrollBar()->maximum(), 0);
    list().setFixedWidth(600);
    settleAll();
    EXPECT_EQ(shown(), all);
}

/// Laid out once more as the style does it.
TEST_F(OverlayPanelTest, NamesOfCausesAreWhole) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    overlay.setBound({{0.02, 0.05}, false});
    settleAll();
    clickLine(0);
    ASSERT_TRUE(overlay.causes().finding() && overlay.causes().finding()->diagnosis);
    QTreeWidget& causes = panel.causes().causes();
    causes.topLevelItem(0)->setText(0, QString("a cause of many words, more than one line holds, ").repeated(2));
    causes.setColumnWidth(1, causes.columnWidth(1) + 1);
    const int side = causes.style()->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, &causes) + 1;
    for (int i = 0; i < causes.topLevelItemCount(); ++i) {
        QTreeWidgetItem& item = *causes.topLevelItem(i);
        QTextLayout text(item.text(0), item.font(0).resolve(causes.font()));
        text.beginLayout();
        double height = 0;
        for (QTextLine line = text.createLine(); line.isValid(); line = text.createLine()) {
            line.setLineWidth(causes.columnWidth(0) - 2 * side);
            height += line.height();
        }
        text.endLayout();
        EXPECT_LE(height, causes.visualItemRect(&item).height()) << item.text(0).toStdString();
        EXPECT_TRUE(i > 0 || text.lineCount() > 1);
    }
    EXPECT_GE(causes.viewport()->height(), causes.visualItemRect(causes.topLevelItem(0)).height());
}

TEST_F(OverlayPanelTest, ListIsLeftAloneWhileItsRowsStay) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    clickLine(0);
    int resets = 0;
    QObject::connect(panel.rollouts(), &QAbstractItemModel::modelReset, &window, [&] { ++resets; });
    list().setCurrentIndex(panel.rollouts()->index(3, 0));
    emit overlay.changed();
    overlay.setRestarts(false);
    EXPECT_EQ(resets, 0);
    EXPECT_EQ(list().currentIndex().row(), 3);
    overlay.setBound({{0.003, 0.02}, false});
    settleAll();
    EXPECT_EQ(resets, 1) << "other rows, and a diagnosis with its progress";
}

/// The rollout that is shown first lies anywhere in it.
TEST_F(OverlayPanelTest, ListOpensWithTheWorstInSightAndStaysWhereItIsScrolledTo) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 1}));
    // From the best of the first few on.
    const auto& rows = overlay.rollouts().rows();
    const auto best =
        std::min_element(rows.begin(), rows.begin() + 5,
                         [](const RolloutRow& one, const RolloutRow& two) { return one.position < two.position; });
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, toSeconds(best->start), 1}));
    const int shown = panel.rollouts()->lineOf(0, 0);
    ASSERT_GE(list().visualRect(panel.rollouts()->index(shown, RolloutList::error)).top(), list().viewport()->height())
        << "a log whose first rollout is none of the worst";
    EXPECT_EQ(list().indexAt({5, 5}).row(), 0);
    // Nor does it go there where room is given and taken.
    const int height = list().height();
    for (const int room :
         {height + list().visualRect(panel.rollouts()->index(shown, RolloutList::error)).bottom(), height}) {
        list().setFixedHeight(room);
        settleAll();
    }
    EXPECT_EQ(list().indexAt({5, 5}).row(), 0);
    EXPECT_EQ(list().selectionModel()->selectedRows().value(0).row(), shown);
    list().verticalScrollBar()->setValue(3);
    overlay.setBound({{0.003, 0.02}, false});
    settleAll();
    EXPECT_EQ(list().indexAt({5, 5}).row(), 3);
    // The next one is looked for.
    overlay.shown().showNext(1);
    settleAll();
    EXPECT_TRUE(list().viewport()->rect().contains(list().visualRect(list().currentIndex()).center()));
}

TEST_F(OverlayPanelTest, ListShowsWholeRows) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 1}));
    const int row = list().visualRect(panel.rollouts()->index(0, RolloutList::error)).height(),
              room = list().viewport()->height();
    for (int more = 0; more < row; ++more) {
        list().setFixedHeight(list().height() + 1);
        settleAll();
        const int left = list().viewport()->height() % row, last = list().viewport()->height() - 1;
        EXPECT_EQ(list().indexAt({5, last}).isValid(), left == 0);
        EXPECT_TRUE(list().indexAt({5, last - left}).isValid());
        // Where a row would be seen in part there is nothing.
        const QImage picture = list().viewport()->grab().toImage();
        std::set<QRgb> colours;
        for (int y = last - left + 1; y <= last; ++y)
            for (int x = 0; x < picture.width(); ++x) colours.insert(picture.pixel(x, y));
        EXPECT_LE(colours.size(), 1u) << "with " << left << " pixels left";
    }
    EXPECT_EQ(list().viewport()->height(), room + row);
}

/// What is left out of a long name is at its end.
TEST_F(OverlayPanelTest, ModelsDifferAtTheFrontOfTheirNames) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    std::size_t kinematic = 0;
    for (const std::string& name : modelNames(*overlay.rollouts().log())) {
        if (!name.starts_with("velocity = command")) continue;
        ++kinematic;
        overlay.models().add(name);
    }
    ASSERT_EQ(kinematic, 3u);
    settleAll();
    std::set<QString> fronts;
    for (int i = 0; i < panel.models().topLevelItemCount(); ++i) {
        const QTreeWidgetItem& item = *panel.models().topLevelItem(i);
        const std::string& whole = overlay.models().all()[static_cast<std::size_t>(i)].name;
        fronts.insert(item.text(0).left(4));
        EXPECT_TRUE(item.toolTip(0).startsWith(qtText(whole))) << whole;
        EXPECT_LE(panel.models().fontMetrics().horizontalAdvance(item.text(0)) + 40, panel.models().columnWidth(0))
            << item.text(0).toStdString();
    }
    EXPECT_EQ(fronts.size(), overlay.models().all().size());
}

TEST_F(OverlayPanelTest, ModelsAreRemovedByKeyAndByName) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    const auto names = modelNames(*overlay.rollouts().log());
    ASSERT_GE(names.size(), 2u);
    overlay.models().add(names[0]);
    overlay.models().add(names[1]);
    settleAll();
    ASSERT_EQ(overlay.models().all().size(), 3u);
    QTreeWidget& models = panel.models();
    models.setFocus();
    models.setCurrentItem(models.topLevelItem(1));
    QTest::keyClick(&models, Qt::Key_Delete);
    settleAll();
    ASSERT_EQ(overlay.models().all().size(), 2u);
    EXPECT_EQ(overlay.models().all()[1].name, names[1]);
    EXPECT_EQ(reality().models.size(), 1u);
    const auto unknown = window.actions().perform("remove_model", QString("nonsense"));
    ASSERT_FALSE(unknown);
    EXPECT_THAT(unknown.error().message(), HasSubstr(names[1]));
    EXPECT_TRUE(window.actions().perform("remove_model", qtText(names[1])));
    EXPECT_EQ(overlay.models().all().size(), 1u);
}

}  // namespace
}  // namespace mrose::gui
