#include "widgets/inspector.h"

#include <QDockWidget>
#include <QHeaderView>
#include <QLabel>
#include <QSignalSpy>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <cmath>
#include <functional>
#include <numbers>

#include "debug/dead_time_queue.h"
#include "debug/plotted_value.h"
#include "gui/window_fixture.h"
#include "panels/plot_panel.h"
#include "quantities/note_label.h"
#include "widgets/eliding_label.h"
#include "widgets/inspector_delegate.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

using Delegate = InspectorDelegate;

class InspectorTest : public WindowTest {
protected:
    Inspector& inspector() { return window.inspector(); }
    QTreeWidget& tree() { return *inspector().findChild<QTreeWidget*>(); }
    const FieldFrame& frame() const { return *window.shown()->frame; }

    void select(std::size_t body) {
        window.field().setSelected(body);
        settle();
    }
    void seek(std::int64_t tick) {
        window.session().seek(tick);
        settle();
    }
    /// The row of that path; its parents are unfolded.
    QTreeWidgetItem* row(const QStringList& names) {
        QTreeWidgetItem* item = tree().invisibleRootItem();
        for (const QString& name : names) {
            item->setExpanded(true);
            QTreeWidgetItem* found = nullptr;
            for (int i = 0; i < item->childCount(); ++i)
                if (item->child(i)->text(0) == name || item->child(i)->text(0).trimmed().startsWith(name + "  "))
                    found = item->child(i);
            if (found == nullptr) {
                ADD_FAILURE() << "no row " << name.toStdString();
                return nullptr;
            }
            item = found;
        }
        return item;
    }
    std::string value(const QStringList& names) {
        const QTreeWidgetItem* item = row(names);
        if (item == nullptr) return {};
        return (item->text(1) + ' ' + item->data(1, Delegate::unitRole).toString()).trimmed().toStdString();
    }
    void clickPlotMark(QTreeWidgetItem* item) {
        tree().scrollToItem(item);
        const QRect box = tree().visualRect(tree().model()->index(0, 0));
        const QRect line = tree().visualItemRect(item);
        const int x = tree().header()->sectionViewportPosition(Delegate::plotColumn) + 8;
        ASSERT_GT(box.height(), 0);
        QTest::mouseClick(tree().viewport(), Qt::LeftButton, Qt::NoModifier, {x, line.center().y()});
        settle();
    }
    static std::string text(double number, int decimals, const char* unit) {
        char buffer[64];
        std::snprintf(buffer, sizeof buffer, "%.*f %s", decimals, number, unit);
        return buffer;
    }
};

TEST_F(InspectorTest, SaysWhereARobotIsAndHowItMoves) {
    seek(300);
    select(1);
    const RobotState& robot = frame().state.robots[1];
    EXPECT_EQ(value({"Motion", "x"}), text(robot.pose.x, 3, "m"));
    EXPECT_EQ(value({"Motion", "y"}), text(robot.pose.y, 3, "m"));
    EXPECT_EQ(value({"Motion", "heading"}),
              text(std::remainder(robot.pose.heading, 2 * std::numbers::pi) * 180 / std::numbers::pi, 1, "\u00b0"));
    EXPECT_EQ(value({"Motion", "v"}), text(robot.velocity_B.x, 3, "m/s"));
    EXPECT_EQ(value({"Motion", "w"}), text(robot.velocity_B.rotation, 3, "rad/s"));
    EXPECT_EQ(value({"Motion", "speed"}), text(std::hypot(robot.velocity_B.x, robot.velocity_B.y), 3, "m/s"));
    select(8);
    const ObjectState& ball = frame().state.objects[0];
    EXPECT_EQ(value({"Motion", "speed"}), text(std::hypot(ball.velocity_W.x, ball.velocity_W.y), 3, "m/s"));
}

TEST_F(InspectorTest, NameAndTypeAreWholeWhereTheyHaveRoomBelowEachOther) {
    Inspector narrow;
    narrow.setFrame(window.shown()->frame);
    narrow.setBody(0);
    narrow.show();
    const auto labels = narrow.findChildren<ElidingLabel*>();
    ASSERT_EQ(labels.size(), 2);
    const QString name = qtText(frame().nameOf(0)), type = qtText(frame().scene().typeOf(0).name);
    for (const QString& text : {name, type}) ASSERT_FALSE(text.isEmpty());
    const int both = labels[0]->fontMetrics().horizontalAdvance(name + "  \u00b7  " + type);
    for (const int missing : {-60, 60}) {
        narrow.resize(both + 40 - missing, 600);
        settle();
        QStringList seen;
        for (const ElidingLabel* label : labels)
            if (label->isVisibleTo(&narrow)) seen << label->shownText();
        EXPECT_EQ(seen, missing > 0 ? QStringList({name, type}) : QStringList(name + "  \u00b7  " + type)) << missing;
    }
}

TEST_F(InspectorTest, SaysWhatIsInEffectByTheDeadTimes) {
    const auto dead = frame().scene().modelOf(2).deadTimes();
    ASSERT_GT(dead.v, 0);
    const auto comingAt = [&](std::int64_t tick) {
        const CommandView view = frame().scenario->commandsOf(frame().state, 2);
        const Nanoseconds now = frame().scene().timeOf(tick);
        int coming = 0;
        for (std::size_t i = 0; i < view.size(); ++i)
            coming += view.issueTime(i) + std::max(dead.v, dead.w) > now ? 1 : 0;
        return coming;
    };
    // A robot that keeps its command issues no other.
    std::int64_t tick = 333;
    for (seek(tick); tick < 1500 && comingAt(tick) < 2; ++tick) seek(tick + 1);
    const int coming = comingAt(tick);
    ASSERT_GT(coming, 1);
    select(2);
    // In closed form: what holds now was issued last at or before now less the dead time.
    const CommandView view = frame().scenario->commandsOf(frame().state, 2);
    const Nanoseconds now = frame().scene().timeOf(tick);
    EXPECT_EQ(value({"Commands", "active_v"}), text(view.at(now - dead.v).v, 3, "m/s"));
    EXPECT_EQ(value({"Commands", "active_w"}), text(view.at(now - dead.w).w, 3, "rad/s"));
    EXPECT_EQ(value({"Commands", "command_w"}), text(view.at(now).w, 3, "rad/s"));
    EXPECT_EQ(value({"Commands", "Not active yet"}), std::to_string(coming) + " commands");
    seek(0);
    EXPECT_EQ(value({"Commands", "Not active yet"}), "none");
}

TEST_F(InspectorTest, SaysWhatContactChangedAndBetweenWhom) {
    const auto pushedAhead = [&](std::uint32_t robot) {
        const Pose& planned = frame().lastTick.robots[robot].planned;
        const Pose& came = frame().state.robots[robot].pose;
        return std::cos(planned.heading) * (came.x - planned.x) + std::sin(planned.heading) * (came.y - planned.y);
    };
    std::uint32_t robot = noBody;
    for (std::int64_t tick = 20; tick < 1500 && robot == noBody; ++tick) {
        seek(tick);
        for (const ContactReport& contact : frame().lastTick.contacts)
            if (contact.bodyA < 8 && frame().lastTick.robots[contact.bodyA].touched && contact.impulse > 0.01 &&
                std::abs(pushedAhead(contact.bodyA)) > 1e-4)
                robot = contact.bodyA;
    }
    ASSERT_NE(robot, noBody);
    select(robot);
    double sum = 0;
    std::map<std::uint32_t, double> with;
    for (const ContactReport& contact : frame().lastTick.contacts)
        if (contact.bodyA == robot || contact.bodyB == robot) {
            sum += contact.impulse;
            with[contact.bodyA == robot ? contact.bodyB : contact.bodyA] += contact.impulse;
        }
    EXPECT_EQ(value({"Motion model", "impulse"}), text(sum, 2, "N s"));
    for (const auto& [other, impulse] : with) {
        const QString name = other == noBody ? "wall" : qtText(frame().nameOf(other));
        EXPECT_EQ(value({"Motion model", "impulse", "with " + name}), text(impulse, 2, "N s"));
    }
    EXPECT_EQ(value({"Motion model", "pushed_ahead"}), text(pushedAhead(robot), 4, "m"));
}

/// What rounds to zero is no warning.
TEST_F(InspectorTest, TouchBelowTheShownDigitsIsQuiet) {
    FieldFrame touched = frame();
    for (const double impulse : {0.3, 0.004}) {
        touched.lastTick.contacts = {{0, 1, 0, {0, 0}, {1, 0}, impulse}};
        const std::vector<InspectorRow> rows = inspectorRows(touched, 0, [](const QString&) { return false; });
        const auto model =
            std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row.name == "Motion model"; });
        ASSERT_NE(model, rows.end());
        const auto contact = std::find_if(model->children.begin(), model->children.end(),
                                          [](const auto& row) { return row.name == "impulse"; });
        ASSERT_NE(contact, model->children.end());
        EXPECT_EQ(contact->notable, impulse > 0.1) << contact->value.toStdString();
        EXPECT_EQ(contact->quiet, impulse < 0.1);
        ASSERT_EQ(contact->children.size(), 1u);
        EXPECT_EQ(contact->children[0].notable, impulse > 0.1);
    }
}

TEST_F(InspectorTest, NumbersAreNotCutWhereThereIsLittleRoom) {
    select(2);
    window.resize(1024, 700);
    settle();
    for (const int width : {330, 240, 230}) {
        inspector().setFixedWidth(width);
        settle();
        const int room = tree().header()->sectionSize(Delegate::valueColumn);
        EXPECT_GE(room, tree().fontMetrics().horizontalAdvance("-12.345 rad/s") + 9) << width;
        EXPECT_LE(tree().header()->length(), tree().viewport()->width()) << width;
        EXPECT_GE(tree().header()->sectionSize(Delegate::nameColumn), 50) << width;
    }
}

TEST_F(InspectorTest, SetsWhatIsSeenAgainstTheTruth) {
    seek(400);
    std::size_t robot = 0;
    while (robot < 8 && frame().insights[robot].observation.robots().empty()) ++robot;
    ASSERT_LT(robot, 8u) << "no robot sees another";
    select(robot);
    const RobotInsight& insight = frame().insights[robot];
    ASSERT_TRUE(insight.observed && insight.observation.localised());
    const Pose& self = insight.observation.self();
    const Pose& pose = frame().state.robots[robot].pose;
    EXPECT_EQ(value({"Sees", "Itself"}), text(std::hypot(self.x - pose.x, self.y - pose.y), 3, "m off"));
    const auto inSight = insight.observation.robots();
    int seen = 0;
    for (std::uint32_t other = 0; other < 8; ++other) {
        if (other == robot) continue;
        const QString name = qtText(frame().nameOf(other));
        const auto found =
            std::find_if(inSight.begin(), inSight.end(), [&](const SeenBody& b) { return b.index == other; });
        if (found == inSight.end()) {
            EXPECT_EQ(value({"Sees", name}), "not in sight");
            continue;
        }
        ++seen;
        const double c = std::cos(self.heading), s = std::sin(self.heading);
        const double x = self.x + c * found->position_B.x - s * found->position_B.y;
        const double y = self.y + s * found->position_B.x + c * found->position_B.y;
        const Pose& truth = frame().state.robots[other].pose;
        EXPECT_EQ(value({"Sees", name}), text(std::hypot(x - truth.x, y - truth.y), 3, "m off"));
        EXPECT_EQ(value({"Sees", name, "seen_x"}), text(x, 3, "m"));
        EXPECT_EQ(value({"Sees", name, "true y"}), text(truth.y, 3, "m"));
        EXPECT_EQ(value({"Sees", name, "seen_age"}),
                  text(toSeconds(frame().scene().timeOf(400) - found->measured), 3, "s"));
    }
    EXPECT_GT(seen, 0);
}

TEST_F(InspectorTest, ShowsTheControllersNotesAndMemory) {
    seek(400);
    select(1);
    for (const Annotation& note : frame().insights[1].decision.annotations) {
        if (note.kind == Annotation::Kind::text) {
            EXPECT_EQ(value({"Controller", qtText(note.label)}), note.text);
        }
    }
    const auto memory = std::as_const(*frame().scenario).memoryOf(frame().state, 1);
    const std::vector<std::byte>& before = frame().insights[1].memoryBefore;
    ASSERT_EQ(before.size(), memory.size());
    std::size_t changed = 0;
    for (std::size_t i = 0; i < memory.size(); ++i) changed += memory[i] != before[i] ? 1 : 0;
    EXPECT_GT(changed, 0u);
    EXPECT_EQ(value({"Memory"}), std::to_string(memory.size()) + " bytes, " + std::to_string(changed) + " changed");
    settle();
    for (const MemoryEntry& entry : explained(frame().scenario->controller(1), memory)) {
        if (entry.unit == "m") {
            EXPECT_EQ(value({"Memory", qtText(entry.name)}), text(entry.value, 3, "m"));
        }
    }
    row({"Memory", "Bytes"})->setExpanded(true);
    settle();
    std::string hex;
    for (std::size_t i = 8; i < 16; ++i) {
        char byte[4];
        std::snprintf(byte, sizeof byte, i == 8 ? "%02x" : " %02x", std::to_integer<unsigned>(memory[i]));
        hex += byte;
    }
    EXPECT_EQ(value({"Memory", "Bytes", "8"}), hex);
}

TEST_F(InspectorTest, MemoryBeforeADecisionIsThatOfTheTickBeforeIt) {
    // First where nothing has been before, then where it has.
    for (std::size_t robot = 0; robot < 16; ++robot) {
        if (robot == 8) seek(0);
        seek(402);
        const RobotInsight& insight = frame().insights[robot % 8];
        WorldState then = frame().scenario->initialState();
        StepBuffers buffers;
        while (then.tick < insight.tick) step(*frame().scenario, then, buffers);
        const auto memory = std::as_const(*frame().scenario).memoryOf(std::as_const(then), robot % 8);
        EXPECT_TRUE(std::equal(memory.begin(), memory.end(), insight.memoryBefore.begin(), insight.memoryBefore.end()))
            << robot;
    }
}

TEST_F(InspectorTest, KeepsSelectionFoldsAndPlaceWhileItPlays) {
    seek(300);
    select(1);
    row({"Motion"})->setExpanded(false);
    QTreeWidgetItem* chosen = row({"Controller", "ball speed"});
    ASSERT_NE(chosen, nullptr);
    tree().setCurrentItem(chosen);
    tree().scrollToItem(chosen);
    const auto key = inspector().currentValue();
    ASSERT_TRUE(key);
    for (int i = 0; i < 120; ++i) seek(300 + i);
    EXPECT_FALSE(tree().topLevelItem(0)->isExpanded());
    EXPECT_EQ(inspector().currentValue(), key);
}

TEST_F(InspectorTest, PlotsByClickKeyAndAction) {
    seek(100);
    select(2);
    clickPlotMark(row({"Motion", "v"}));
    EXPECT_EQ(window.plots().keys(), (std::vector<ValueKey>{{"v", "red 3"}}));
    EXPECT_TRUE(window.plots().isVisible());
    tree().setCurrentItem(row({"Motion", "w"}));
    tree().setFocus();
    QTest::keyClick(&tree(), Qt::Key_Return);
    EXPECT_EQ(window.plots().keys().size(), 2u);
    window.actions()["plot_value"].trigger();
    EXPECT_EQ(window.plots().keys().size(), 1u) << "a second time takes it away";
    window.actions()["plot_value_of_all"].trigger();
    EXPECT_EQ(window.plots().keys().size(), 9u);
    clickPlotMark(row({"Motion", "v"}));
    EXPECT_EQ(window.plots().keys().size(), 8u);
    tree().setCurrentItem(row({"Controller", "state"}));
    EXPECT_FALSE(inspector().currentValue()) << "a text is no number";
    window.actions()["clear_plots"].trigger();
    EXPECT_TRUE(window.plots().keys().empty());
}

class QueueTest : public testing::Test {
protected:
    static constexpr Nanoseconds ms = 1'000'000;
    QueueTest() {
        queue.resize(320, queue.sizeHint().height());
        content.commands = {
            {1000 * ms, {0.1, 0}}, {1100 * ms, {0.2, 0}}, {1200 * ms, {0.2, 0.5}}, {1300 * ms, {0.4, -0.5}}};
        content.now = 1350 * ms;
        content.deadTimes = {300 * ms, 200 * ms};
        content.period = 100 * ms;
        content.lastInstant = 1300 * ms;
        content.colour = QColor(0, 114, 178);
    }
    CommandQueue queue;
    CommandQueue::Content content;
};

TEST_F(QueueTest, CountsUntilEachTakesEffectByTheDeadTimes) {
    queue.setContent(content);
    const CommandsOnTheWay way = commandsOnTheWay(content);
    EXPECT_EQ(way.active, (Command{0.1, 0}));  // issued at 1.0 s: forward speed in effect since 1.3 s
    ASSERT_EQ(way.coming.size(), 3u);
    for (const CommandsOnTheWay::Coming& one : way.coming) {
        EXPECT_EQ(one.untilV, std::max<Nanoseconds>(0, one.issued.time + 300 * ms - 1350 * ms));
        EXPECT_EQ(one.untilW, std::max<Nanoseconds>(0, one.issued.time + 200 * ms - 1350 * ms));
    }
    ASSERT_EQ(queue.instants().size(), 4u);
    EXPECT_EQ(queue.instants()[1].untilV, 50 * ms);
    EXPECT_EQ(queue.instants()[3].untilW, 150 * ms);
    EXPECT_TRUE(queue.textOf(queue.instants()[3]).contains("in 250 ms"));
    EXPECT_TRUE(queue.textOf(queue.instants()[3]).contains("0.4000 m/s, -0.5000 rad/s"));
    EXPECT_TRUE(queue.textOf(queue.instants()[3]).contains("1.30 s"));
}

TEST_F(QueueTest, WhoIsToldToGoOnIsSeenTravellingToo) {
    content.commands = {{1000 * ms, {0.1, 0}}};
    queue.setContent(content);
    std::vector<Nanoseconds> issued;
    for (const CommandQueue::Instant& instant : queue.instants()) issued.push_back(instant.issued);
    EXPECT_EQ(issued, (std::vector<Nanoseconds>{1000 * ms, 1100 * ms, 1200 * ms, 1300 * ms}));
    for (const CommandQueue::Instant& instant : queue.instants()) EXPECT_EQ(instant.command, (Command{0.1, 0}));
}

/// Forward speed fills its lane up to the level of the command, from where that takes effect.
TEST_F(QueueTest, DrawsEachCommandWhereItsTimeIs) {
    content.commands = {{1000 * ms, {0, 0}}, {1200 * ms, {0.5, 0}}};
    content.period = 0;
    queue.setContent(content);
    const QImage image = queue.grab().toImage();
    const double begins = queue.pixelOf(150 * ms);
    EXPECT_NEAR(begins, (queue.pixelOf(0) + queue.pixelOf(300 * ms)) / 2, 1e-9);
    EXPECT_GT(queue.pixelOf(300 * ms), queue.width() - 10) << "what is told now, at the right end";
    const auto filled = [&](double x) {
        int count = 0;
        for (int y = 18; y < 60; ++y) {  // below the title
            const QColor pixel = image.pixelColor(static_cast<int>(x), y);
            count += pixel.blue() - pixel.red() > 60 ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(filled(begins + 40), 20);
    EXPECT_GT(filled(queue.pixelOf(290 * ms)), 20);
    EXPECT_LT(filled(begins - 6), 3);
    EXPECT_LT(filled(queue.pixelOf(20 * ms)), 3);
    // 100 ms later it has come nearer by as much.
    content.now += 100 * ms;
    queue.setContent(content);
    EXPECT_NEAR(queue.pixelOf(queue.instants().back().untilV), queue.pixelOf(50 * ms), 1e-9);
}

TEST_F(QueueTest, ADoubleClickAsksForTheCommandThere) {
    queue.setContent(content);
    queue.show();
    QSignalSpy asked(&queue, &CommandQueue::commandActivated);
    const QPoint place(static_cast<int>(queue.pixelOf(100 * ms)), 20);  // told at 1.1 s: takes effect in 50 to 150 ms
    QTest::mouseDClick(&queue, Qt::LeftButton, Qt::NoModifier, place);
    ASSERT_EQ(asked.size(), 1);
    EXPECT_EQ(asked[0][0].toLongLong(), 1100 * ms);
    queue.setFocus();
    QTest::keyClick(&queue, Qt::Key_Right);
    QTest::keyClick(&queue, Qt::Key_Return);
    ASSERT_EQ(asked.size(), 2);
}

TEST_F(InspectorTest, NumbersOfNotesHaveTheirUnits) {
    seek(300);
    select(1);
    const std::string speed = value({"Controller", "ball speed"});
    EXPECT_TRUE(speed.ends_with(" m/s")) << speed;
    EXPECT_EQ(noteLabel("ball speed (m/s)").name, "ball speed");
    EXPECT_EQ(noteLabel("ball speed (m/s)").unit, "m/s");
    EXPECT_EQ(noteLabel("state").name, "state");
    EXPECT_EQ(noteLabel("(m)").unit, "");
}

/// At its first width: nothing that is said in words is cut.
TEST_F(InspectorTest, WordsThatDoNotFitTakeAnotherLine) {
    window.resize(1280, 800);
    seek(300);
    select(1);
    const int line = tree().fontMetrics().height();
    QTreeWidgetItem* shot = row({"Controller", "shot"});
    ASSERT_NE(shot, nullptr);
    ASSERT_GT(tree().fontMetrics().horizontalAdvance(shot->text(1)), tree().columnWidth(Delegate::valueColumn) + 24);
    EXPECT_GE(tree().visualItemRect(shot).height(), 2 * line) << shot->text(1).toStdString();
    const QTreeWidgetItem* told = row({"Controller", "Decided at"});
    EXPECT_LT(tree().visualItemRect(told).height(), 2 * line);
    // Wider again, it takes one.
    window.resizeDocks({window.findChild<QDockWidget*>("inspector")}, {600}, Qt::Horizontal);
    settle();
    EXPECT_LT(tree().visualItemRect(shot).height(), 2 * line);
}

TEST_F(InspectorTest, NamesAreShownWhole) {
    seek(300);
    select(1);
    for (const QStringList& section : {QStringList{"Memory"}, {"Sees", "Itself"}}) row(section)->setExpanded(true);
    const auto lines = [&](const QModelIndex& index) {
        return tree().visualRect(index).height() / tree().fontMetrics().height();
    };
    int wrapped = 0;
    for (const int width : {330, 246}) {
        window.resizeDocks({window.findChild<QDockWidget*>("inspector")}, {width}, Qt::Horizontal);
        settle();
        const std::function<void(const QModelIndex&)> check = [&](const QModelIndex& above) {
            for (int i = 0; i < tree().model()->rowCount(above); ++i) {
                const QModelIndex index = tree().model()->index(i, Delegate::nameColumn, above);
                if (tree().isExpanded(index)) check(index);
                if (tree().isFirstColumnSpanned(i, above)) continue;
                const bool whole = Delegate::nameWidth(tree(), index) <= tree().columnWidth(Delegate::nameColumn);
                EXPECT_TRUE(whole || lines(index) >= 2) << width << ' ' << index.data().toString().toStdString();
                EXPECT_TRUE(whole || width < 330 || above.isValid()) << index.data().toString().toStdString();
                wrapped += whole ? 0 : 1;
            }
        };
        check({});
    }
    EXPECT_GT(wrapped, 0) << "it is narrow";
}

TEST_F(InspectorTest, CountsAreWholeAndWhatIsNotKnownHasNoUnit) {
    seek(300);
    select(1);
    EXPECT_EQ(value({"Memory", "measurements refused"}).find('.'), std::string::npos);
    EXPECT_NE(value({"Memory", "aim x"}).find('.'), std::string::npos);
    for (QTreeWidgetItemIterator item(&tree()); *item != nullptr; ++item) {
        const bool unknown = (*item)->text(1) == QString::fromUtf8("\u2013");
        EXPECT_TRUE(!unknown || (*item)->data(1, Delegate::unitRole).toString().isEmpty())
            << (*item)->text(0).toStdString();
    }
}

}  // namespace
}  // namespace mrose::gui
