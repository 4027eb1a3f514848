#include <cmath>

#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"

namespace mrose {
namespace {

TEST(DrawnNormal, IsTheQuantile) {
    double worst = 0;
    const auto compare = [&](double p) {
        const double exact = normalQuantile(p);
        worst = std::max(worst, std::abs(drawnNormal(p) / exact - 1));
        EXPECT_EQ(drawnNormal(1 - p), -drawnNormal(p)) << p;
    };
    for (int i = 1; i < 20000; ++i)
        if (i != 10000) compare(std::ldexp(std::round(std::ldexp(i / 20000.0, 32)), -32));
    for (int bits = 2; bits <= 33; ++bits) compare(std::ldexp(1, -bits));
    EXPECT_LT(worst, 1e-7);
    EXPECT_EQ(drawnNormal(0.5), 0);
}

TEST(DrawnNormal, GrowsAlsoWhereTheFitsMeet) {
    for (const double edge : {0.025, 0.975})
        for (int i = -1000; i < 1000; ++i)
            EXPECT_LE(drawnNormal(edge + i * 0x1p-27), drawnNormal(edge + (i + 1) * 0x1p-27)) << edge << ' ' << i;
}

TEST(DrawnNormal, SeveralAreTheSame) {
    for (int i = 1; i < 5000; ++i) {
        const std::array<double, 3> p{i / 5000.0, std::ldexp(i, -20), 1 - std::ldexp(i, -18)};
        const auto normals = drawnNormals(p);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(normals[k], drawnNormal(p[k])) << p[k];
    }
}

}  // namespace
}  // namespace mrose
