#include "widgets/message_bar.h"

#include <QApplication>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTest>
#include <QToolButton>
#include <cmath>

#include <gmock/gmock.h>

namespace mrose {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Kind = MessageBar::Kind;

class MessageBarTest : public testing::Test {
protected:
    MessageBarTest() {
        bar.resize(900, 200);
        bar.show();
    }
    std::vector<std::string> texts() const {
        std::vector<std::string> texts;
        for (const MessageBar::Message& message : bar.messages()) texts.push_back(message.text.toStdString());
        return texts;
    }
    MessageBar bar;
};

TEST_F(MessageBarTest, TakesRoomOnlyWhileThereIsSomethingToSay) {
    MessageBar empty;
    EXPECT_TRUE(empty.isHidden());
    empty.add({Kind::note, "a"});
    EXPECT_FALSE(empty.isHidden());
    EXPECT_TRUE(empty.dismiss());
    EXPECT_TRUE(empty.isHidden());
    EXPECT_FALSE(empty.dismiss());
}

TEST_F(MessageBarTest, OneOfTheSameTopicTakesTheOldOnesPlace) {
    bar.add({Kind::error, "a", "reload"});
    bar.add({Kind::note, "b"});
    bar.add({Kind::note, "b"});
    bar.add({Kind::error, "c", "reload"});
    EXPECT_THAT(texts(), ElementsAre("b", "c"));
    bar.remove("reload");
    EXPECT_THAT(texts(), ElementsAre("b"));
}

TEST_F(MessageBarTest, NotesGiveWayBeforeErrorsAndTheNewestStays) {
    for (const char* text : {"e1", "e2", "e3"}) bar.add({Kind::error, text});
    bar.add({Kind::note, "n"});
    bar.add({Kind::error, "e4"});
    EXPECT_THAT(texts(), ElementsAre("e1", "e2", "e3", "e4"));
    bar.add({Kind::note, "last"});
    EXPECT_THAT(texts(), ElementsAre("e2", "e3", "e4", "last"));
}

TEST_F(MessageBarTest, MoreThanTwoNotesFoldIntoALineThatOpens) {
    const auto seen = [&] {
        QApplication::processEvents();
        std::vector<std::string> lines;
        for (const QLabel* label : bar.findChildren<QLabel*>("message_text"))
            if (label->isVisible()) lines.push_back(label->text().toStdString());
        return lines;
    };
    const auto offered = [&]() -> QToolButton* {
        for (auto* button : bar.findChildren<QToolButton*>("more_notes"))
            if (button->isVisible()) return button;
        return nullptr;
    };
    bar.add({Kind::note, "a"});
    bar.add({Kind::note, "b"});
    EXPECT_THAT(seen(), ElementsAre("a", "b"));
    EXPECT_EQ(offered(), nullptr);
    bar.add({Kind::note, "c"});
    bar.add({Kind::error, "broken"});
    EXPECT_THAT(seen(), ElementsAre("c", "broken")) << "errors are always seen";
    EXPECT_THAT(texts(), ElementsAre("a", "b", "c", "broken")) << "all are still there";
    ASSERT_NE(offered(), nullptr);
    EXPECT_EQ(offered()->text(), "2 more");
    QTest::mouseClick(offered(), Qt::LeftButton);
    EXPECT_THAT(seen(), ElementsAre("a", "b", "c", "broken"));
    QTest::mouseClick(offered(), Qt::LeftButton);
    EXPECT_THAT(seen(), ElementsAre("c", "broken"));
    ASSERT_TRUE(bar.dismiss());
    ASSERT_TRUE(bar.dismiss());
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    EXPECT_THAT(seen(), ElementsAre("a", "b"));
    EXPECT_EQ(offered(), nullptr);
}

TEST_F(MessageBarTest, ProgressGoesOnInItsLineAndIsNotDismissed) {
    bar.add({Kind::progress, "Saving", "work", {}, 0.25});
    auto* progress = bar.findChild<QProgressBar*>();
    ASSERT_NE(progress, nullptr);
    EXPECT_EQ(progress->value() * 4, progress->maximum());
    bar.add({Kind::progress, "Saving", "work", {}, 0.5});
    EXPECT_EQ(bar.findChild<QProgressBar*>(), progress);
    EXPECT_EQ(progress->value() * 2, progress->maximum());
    EXPECT_FALSE(bar.dismiss());
}

TEST_F(MessageBarTest, ButtonsActAndTheCrossDismisses) {
    int pressed = 0;
    bar.add({Kind::error, "broken", "", {{"Again", "Try it again", [&] {
                                              ++pressed;
                                              bar.clear();
                                          }}}});
    QTest::mouseClick(bar.findChild<QPushButton*>(), Qt::LeftButton);
    EXPECT_EQ(pressed, 1);
    EXPECT_THAT(texts(), IsEmpty());
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    bar.add({Kind::note, "read me"});
    EXPECT_TRUE(bar.findChild<QLabel*>("message_text")->textInteractionFlags().testFlag(Qt::TextSelectableByMouse));
    QTest::mouseClick(bar.findChild<QToolButton*>("dismiss"), Qt::LeftButton);
    EXPECT_THAT(texts(), IsEmpty());
}

/// Each line of text and the sign beside it are readable on both themes: WCAG 2.1 asks for 4.5 to 1.
TEST_F(MessageBarTest, TextStandsOutFromItsGround) {
    const auto luminance = [](const QColor& colour) {
        const auto part = [](double x) { return x <= 0.03928 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); };
        return 0.2126 * part(colour.redF()) + 0.7152 * part(colour.greenF()) + 0.0722 * part(colour.blueF());
    };
    for (const Theme& theme : {Theme::light(), Theme::darkOne()})
        for (const Kind kind : {Kind::note, Kind::error}) {
            bar.clear();
            bar.setTheme(theme);
            bar.add({kind, "text"});
            QApplication::processEvents();
            const QImage image = bar.grab().toImage();
            const double ground = luminance(image.pixelColor(image.width() / 2, 3)), text = luminance(theme.text);
            EXPECT_GT((std::max(ground, text) + 0.05) / (std::min(ground, text) + 0.05), 4.5);
        }
}

TEST_F(MessageBarTest, StandsOverAnothersUpperEdgeAndMovesNothing) {
    QWidget host;
    host.resize(600, 400);
    host.show();
    MessageBar over;
    over.standOver(host);
    const QSize before = host.size();
    over.add({Kind::error, "one.toml: it is not there"});
    QApplication::processEvents();
    const int one = over.height();
    over.add({Kind::error, QString("two ").repeated(80), "two"});
    QApplication::processEvents();
    EXPECT_EQ(host.size(), before);
    EXPECT_EQ(over.parentWidget(), &host);
    EXPECT_EQ(over.geometry().topLeft(), QPoint(0, 0));
    EXPECT_EQ(over.width(), 600);
    EXPECT_GT(over.height(), 2 * one) << "the second takes several lines";
    host.resize(500, 400);
    QApplication::processEvents();
    EXPECT_EQ(over.width(), 500);
    ASSERT_TRUE(over.dismiss());
    QApplication::processEvents();
    EXPECT_EQ(over.height(), one);
}

TEST_F(MessageBarTest, SeveralHideNoMoreThanAQuarterOfTheirHost) {
    QWidget host;
    host.resize(460, 250);
    host.show();
    bar.standOver(host);
    const QString text = QString("something that takes two lines of words where it stands ").repeated(2);
    for (const char* which : {"1", "2"}) {
        bar.add({Kind::error, "error " + text + which});
        bar.add({Kind::note, "note " + text + which});
    }
    QApplication::processEvents();
    const auto seen = [&] {
        QStringList texts;
        for (const QLabel* label : bar.findChildren<QLabel*>("message_text"))
            if (label->isVisible()) texts << label->text();
        return texts;
    };
    EXPECT_EQ(seen(), QStringList{"error " + text + "2"});
    EXPECT_LE(bar.height(), 0.25 * host.height());
    EXPECT_TRUE(bar.dismiss()) << "what is seen goes first";
    QApplication::processEvents();
    EXPECT_EQ(seen(), QStringList{"error " + text + "1"});
    for (auto* button : bar.findChildren<QToolButton*>("more_notes"))
        if (button->isVisible()) {
            EXPECT_EQ(button->text(), "2 more");
            button->click();
            break;
        }
    EXPECT_EQ(seen().size(), 3);
    host.resize(1600, 1000);
    QApplication::processEvents();
    EXPECT_EQ(seen().size(), 3) << "there is room for them";
    bar.setParent(nullptr);
}

}  // namespace
}  // namespace mrose
