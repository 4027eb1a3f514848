#include "report/residual_figure.h"

#include <regex>

#include <gtest/gtest.h>

#include "drawing/svg_plot.h"
#include "support/markup.h"

namespace mrose {
namespace {

TEST(ResidualFigure, DotsAreWholeAndStayDarkWhereTheyAreDense) {
    std::vector<ResidualDot> dots;
    for (int i = 0; i <= 100; ++i) dots.push_back({0.3 * i, i % 2 == 0 ? 1.0 : -1.0, -0.8, 0.8});
    const std::string figure = residualFigure(dots, "title", "x", "y");
    EXPECT_EQ(countOf(figure, "class=\"realdot\""), dots.size()) << "marks that are few have a rim";
    EXPECT_EQ(markupError(figure), "");
    const SvgPlot::Layout frame{.width = 440, .height = 300};
    const std::regex circle("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\" r=\"([0-9.]+)\"");
    std::size_t circles = 0;
    for (std::sregex_iterator it(figure.begin(), figure.end(), circle), end; it != end; ++it, ++circles) {
        const double x = std::stod((*it)[1]), y = std::stod((*it)[2]), radius = std::stod((*it)[3]);
        EXPECT_GE(x - radius, frame.left);
        EXPECT_LE(x + radius, frame.width - frame.right);
        EXPECT_GE(y - radius, frame.top);
        EXPECT_LE(y + radius, frame.height - frame.bottom);
    }
    EXPECT_EQ(circles, dots.size());
}

}  // namespace
}  // namespace mrose
