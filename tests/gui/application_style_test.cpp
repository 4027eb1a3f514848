// What the style draws otherwise than Fusion.
#include "application_style.h"

#include <QApplication>
#include <QCheckBox>
#include <QHeaderView>
#include <QScrollBar>
#include <QTableWidget>
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "frame/theme_palette.h"

namespace mrose::gui {
namespace {

QImage grabbed(QWidget& widget) {
    QApplication::processEvents();
    return widget.grab().toImage().convertToFormat(QImage::Format_RGB32);
}

TEST(ApplicationStyleTest, FramesOfEmptyCheckBoxesStandOut) {
    for (const Theme& theme : {Theme::light(), Theme::darkOne()}) {
        QCheckBox box;
        box.setPalette(paletteOf(theme));
        box.setAutoFillBackground(true);
        box.resize(40, 24);
        box.show();
        const QImage picture = grabbed(box);
        // Across the box: its two sides, and nothing else that stands out.
        int sides = 0;
        for (int x = 0; x < picture.width(); ++x)
            sides += contrast(picture.pixelColor(x, picture.height() / 2), theme.panel) >= 3 ? 1 : 0;
        EXPECT_EQ(sides, 2) << (theme.dark ? "dark" : "light");
    }
}

/// From one end to the other, along its middle.
std::vector<QColor> alongBar(const Theme& theme, int at) {
    QScrollBar bar(Qt::Vertical);
    bar.setPalette(paletteOf(theme));
    bar.setRange(0, 100);
    bar.setPageStep(40);
    bar.setValue(at);
    bar.resize(bar.sizeHint().width(), 240);
    bar.show();
    const QImage picture = grabbed(bar);
    std::vector<QColor> colours;
    for (int y = 0; y < picture.height(); ++y) colours.push_back(picture.pixelColor(picture.width() / 2, y));
    return colours;
}

TEST(ApplicationStyleTest, HandleOfAScrollBarIsWhatStandsOut) {
    for (const Theme& theme : {Theme::light(), Theme::darkOne()}) {
        const std::vector<QColor> top = alongBar(theme, 0), bottom = alongBar(theme, 100);
        // The handle goes from the upper end to the lower one.
        const QColor handle = top[40], groove = bottom[40];
        EXPECT_EQ(bottom[200], handle);
        EXPECT_EQ(top[200], groove);
        EXPECT_GE(contrast(handle, groove), 3) << (theme.dark ? "dark" : "light");
        EXPECT_LT(contrast(groove, theme.panel), 1.3) << "the groove is quiet";
    }
}

/// Of a title without words: how wide its arrow is, from above.
std::vector<int> arrowOf(Qt::SortOrder order) {
    QTableWidget table(1, 1);
    table.setHorizontalHeaderLabels({""});
    table.horizontalHeader()->setSortIndicatorShown(true);
    table.horizontalHeader()->setSortIndicator(0, order);
    table.show();
    QApplication::processEvents();
    const QImage shown = grabbed(*table.horizontalHeader()->viewport());
    table.horizontalHeader()->setSortIndicatorShown(false);
    const QImage plain = grabbed(*table.horizontalHeader()->viewport());
    std::vector<int> widths;
    for (int y = 0; y < shown.height(); ++y) {
        int width = 0;
        for (int x = 0; x < shown.width(); ++x) width += shown.pixel(x, y) != plain.pixel(x, y) ? 1 : 0;
        if (width > 0) widths.push_back(width);
    }
    return widths;
}

TEST(ApplicationStyleTest, ArrowPointsDownWhereTheLargestComesFirst) {
    const std::vector<int> down = arrowOf(Qt::DescendingOrder), up = arrowOf(Qt::AscendingOrder);
    ASSERT_GT(down.size(), 2u);
    EXPECT_GT(down.front(), down.back());
    EXPECT_LT(up.front(), up.back());
}

}  // namespace
}  // namespace mrose::gui
