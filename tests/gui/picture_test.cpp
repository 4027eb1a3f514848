// Pictures of the view, as files.
#include <QImage>
#include <QRegularExpression>
#include <QXmlStreamReader>
#include <filesystem>

#include <gmock/gmock.h>

#include "files/window_files.h"
#include "gui/file_fixture.h"
#include "io/file.h"
#include "support/full_disk.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

class PictureTest : public FileTest {
protected:
    void SetUp() override {
        open(writeGame());
        seek(40);
    }
    std::string save(const std::string& name) {
        const auto saved = window.actions().perform("save_image", qPath(name));
        return saved ? "" : saved.error().message();
    }
    QPointF pixelOf(std::size_t body) {
        const Pose& pose = window.shown()->frame->poseOf(body);
        return window.field().transform().toPixels({pose.x, pose.y});
    }
};

TEST_F(PictureTest, PngShowsWhatTheViewShowsTwiceAsFine) {
    ASSERT_EQ(save("a.png"), "");
    const QImage picture(qPath("a.png"));
    ASSERT_EQ(picture.size(), window.field().size() * 2);
    // Half as fine it is what the screen shows.
    const QImage screen = window.field().grab().toImage().convertToFormat(QImage::Format_RGB32);
    const QImage half = picture.scaled(screen.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                            .convertToFormat(QImage::Format_RGB32);
    const auto apart = [](const QColor& a, const QColor& b) {
        return std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue());
    };
    double sum = 0;
    for (int y = 0; y < screen.height(); ++y)
        for (int x = 0; x < screen.width(); ++x) sum += apart(screen.pixelColor(x, y), half.pixelColor(x, y));
    EXPECT_LT(sum / (screen.width() * screen.height()), 3);
    const QPoint ball = pixelOf(2).toPoint(), floor = ball + QPoint(0, 60);
    EXPECT_LT(apart(screen.pixelColor(ball), half.pixelColor(ball)), 30);
    EXPECT_GT(apart(half.pixelColor(ball), half.pixelColor(floor)), 100);
}

TEST_F(PictureTest, SvgIsWellFormedAndNamesTheRobots) {
    ASSERT_EQ(save("a.svg"), "");
    QFile file(qPath("a.svg"));
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    QXmlStreamReader xml(&file);
    QStringList texts;
    int paths = 0;
    QString viewBox;
    while (!xml.atEnd()) {
        if (xml.readNext() == QXmlStreamReader::StartElement) {
            if (xml.name() == QString("svg")) viewBox = xml.attributes().value("viewBox").toString();
            paths += xml.name() == QString("path") || xml.name() == QString("polyline") ? 1 : 0;
        }
        if (xml.isCharacters() && !xml.isWhitespace()) texts << xml.text().toString().trimmed();
    }
    EXPECT_FALSE(xml.hasError()) << xml.errorString().toStdString();
    for (const char* name : {"one", "two"}) EXPECT_TRUE(texts.contains(name)) << name;
    EXPECT_GT(paths, 10);
    EXPECT_EQ(viewBox, QString("0 0 %1 %2").arg(window.field().width()).arg(window.field().height()));
}

TEST_F(PictureTest, TurnedFieldSaysWhereItsAxesPoint) {
    const auto says = [&](const char* name) {
        EXPECT_EQ(save(name), "");
        return readFile(path(name)).value_or("").find("turned: x up, y left") != std::string::npos;
    };
    EXPECT_FALSE(says("upright.svg"));
    window.actions()["turn"].trigger();
    EXPECT_TRUE(says("turned.svg"));
}

TEST_F(PictureTest, PdfHasOnePageOfTheViewsProportions) {
    ASSERT_EQ(save("a.pdf"), "");
    const std::string bytes = readFile(path("a.pdf")).value_or("");
    EXPECT_TRUE(bytes.starts_with("%PDF-1."));
    EXPECT_THAT(bytes, testing::HasSubstr("%%EOF"));
    const QString pdf = QString::fromLatin1(bytes.data(), static_cast<int>(bytes.size()));
    EXPECT_TRUE(pdf.contains(QRegularExpression("/Count 1\\b")));
    const auto box = QRegularExpression("/MediaBox \\[0 0 ([0-9.]+) ([0-9.]+)\\]").match(pdf);
    ASSERT_TRUE(box.hasMatch());
    const QSizeF expected = QSizeF(window.field().size()) * 72 / window.field().logicalDpiX();
    EXPECT_NEAR(box.captured(1).toDouble(), expected.width(), 1);
    EXPECT_NEAR(box.captured(2).toDouble(), expected.height(), 1);
}

TEST_F(PictureTest, OtherExtensionsAndFullDisksLeaveWhatWasThere) {
    EXPECT_THAT(save("a.bmp"), testing::HasSubstr("expected .png, .svg or .pdf"));
    EXPECT_THAT(save("a"), testing::HasSubstr("expected .png, .svg or .pdf"));
    write("old.svg", "old");
    {
        const FullDisk full(1000);
        EXPECT_THAT(save("old.svg"), testing::HasSubstr("cannot be written"));
    }
    EXPECT_EQ(readFile(path("old.svg")).value_or(""), "old");
    EXPECT_FALSE(std::filesystem::exists(path("a.bmp")));
    std::filesystem::create_directory(path("folder.png"));
    EXPECT_THAT(save("folder.png"), testing::HasSubstr("is a folder"));
}

}  // namespace
}  // namespace mrose::gui
