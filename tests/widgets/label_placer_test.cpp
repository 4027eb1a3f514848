#include "widgets/label_placer.h"

#include <QLineF>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace mrose {
namespace {

constexpr double bodyRadius = 18;
const QRectF frame(0, 0, 900, 600);

std::vector<LabelPlacer::Placed> placed(LabelPlacer& placer, const std::vector<QPointF>& bodies) {
    placer.begin(frame);
    for (const QPointF& at : bodies)
        placer.avoid({at - QPointF(bodyRadius, bodyRadius), QSizeF(2 * bodyRadius, 2 * bodyRadius)});
    std::vector<LabelPlacer::Placed> labels;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (auto label = placer.place({i, bodies[i], bodyRadius, {54, 17}})) labels.push_back(*label);
    return labels;
}

TEST(LabelPlacer, LabelsOfACrowdNeitherOverlapNorLeaveThePicture) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> x(20, 880), y(20, 580), close(-70, 70);
    for (int round = 0; round < 40; ++round) {
        const QPointF crowd(x(random), y(random));
        std::vector<QPointF> bodies;
        for (int i = 0; i < 9; ++i) bodies.push_back(crowd + QPointF(close(random), close(random)));
        LabelPlacer placer;
        const auto labels = placed(placer, bodies);
        EXPECT_GE(labels.size(), 8u);
        for (std::size_t i = 0; i < labels.size(); ++i) {
            EXPECT_TRUE(frame.contains(labels[i].box));
            for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(labels[i].box.intersects(labels[j].box)) << i << ' ' << j;
        }
    }
}

TEST(LabelPlacer, LabelStandsOffBodiesWhereThereIsRoom) {
    LabelPlacer placer;
    const std::vector<QPointF> bodies{{300, 300}, {300, 340}, {340, 300}, {300, 260}};
    for (const LabelPlacer::Placed& label : placed(placer, bodies))
        for (const QPointF& body : bodies) {
            const QRectF square(body - QPointF(bodyRadius, bodyRadius), QSizeF(2 * bodyRadius, 2 * bodyRadius));
            const QRectF both = label.box & square;
            EXPECT_LE(std::max(0.0, both.width()) * std::max(0.0, both.height()), 90);
        }
}

TEST(LabelPlacer, LabelsGoAlongWithBodiesThatPassOneAnother) {
    LabelPlacer placer;
    std::vector<QPointF> offsets(3);
    int jumps = 0;
    for (int step = 0; step <= 300; ++step) {
        const std::vector<QPointF> bodies{{300.0 + step, 300}, {600.0 - step, 310}, {450, 305}};
        const auto labels = placed(placer, bodies);
        ASSERT_EQ(labels.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            const QPointF offset = labels[i].box.center() - bodies[i];
            jumps += step > 0 && QLineF(offset, offsets[i]).length() > 1 ? 1 : 0;
            offsets[i] = offset;
        }
    }
    EXPECT_LE(jumps, 12) << "in 300 pictures";
}

TEST(LabelPlacer, LabelsOfATremblingCrowdStay) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> close(-60, 60), tremble(-1.5, 1.5);
    int jumps = 0;
    for (int crowd = 0; crowd < 10; ++crowd) {
        std::vector<QPointF> middles;
        for (int i = 0; i < 7; ++i) middles.push_back(QPointF(400, 300) + QPointF(close(random), close(random)));
        LabelPlacer placer;
        std::vector<QPointF> offsets(middles.size());
        for (int picture = 0; picture < 100; ++picture) {
            std::vector<QPointF> bodies;
            for (const QPointF& at : middles) bodies.push_back(at + QPointF(tremble(random), tremble(random)));
            const auto labels = placed(placer, bodies);
            ASSERT_EQ(labels.size(), bodies.size());
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                const QPointF offset = labels[i].box.center() - bodies[i];
                jumps += picture > 0 && QLineF(offset, offsets[i]).length() > 1 ? 1 : 0;
                offsets[i] = offset;
            }
        }
    }
    EXPECT_LE(jumps, 70) << "in 7000 places";
}

TEST(LabelPlacer, LabelsLeaveFreeWhatIsKept) {
    LabelPlacer placer;
    placer.begin(frame);
    const auto usual = placer.place({1, {300, 300}, bodyRadius, {54, 17}});
    placer.begin(frame);
    placer.keepFree(usual->box);
    EXPECT_FALSE(placer.place({1, {300, 300}, bodyRadius, {54, 17}})->box.intersects(usual->box));
}

TEST(LabelPlacer, WhereThereIsNoRoomThereIsNoLabel) {
    LabelPlacer placer;
    placer.begin({0, 0, 50, 20});
    EXPECT_TRUE(placer.place({1, {25, 0}, 0, {40, 10}}).has_value());
    EXPECT_FALSE(placer.place({2, {25, 0}, 0, {40, 10}}).has_value());
}

}  // namespace
}  // namespace mrose
