#include "widgets/eliding_text.h"

#include <QString>

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(ElidingText, TakesTheRoomOfItsLinesWhateverItSays) {
    ElidingText text(2);
    const int height = text.sizeHint().height();
    const QString words = QString("some words ").repeated(40);
    for (const QString& said : {QString(), QString("one"), words}) {
        text.setText(said);
        EXPECT_EQ(text.sizeHint().height(), height);
        EXPECT_EQ(text.minimumSizeHint().height(), height);
        EXPECT_EQ(text.text(), said);
    }
    EXPECT_GE(height, text.fontMetrics().boundingRect({0, 0, 500, 500}, Qt::TextWordWrap, "gj\ngj").height());
}

TEST(ElidingText, ShowsWholeLinesThatFitAndSaysThatThereIsMore) {
    ElidingText text(2);
    text.resize(180, text.sizeHint().height());
    const QString words = "the first of many words that are too long for two lines of so narrow a text as this one is";
    text.setText(words);
    const QStringList lines = text.shownText().split('\n');
    ASSERT_EQ(lines.size(), 2);
    for (const QString& line : lines) EXPECT_LE(text.fontMetrics().horizontalAdvance(line), 180) << line.toStdString();
    EXPECT_TRUE(words.startsWith(lines[0] + ' '));
    EXPECT_TRUE(lines[1].endsWith(QChar(0x2026)));
    EXPECT_TRUE(words.startsWith(lines[0] + ' ' + lines[1].chopped(1).trimmed()));
    text.setText("few words");
    EXPECT_EQ(text.shownText(), "few words");
}

}  // namespace
}  // namespace mrose
