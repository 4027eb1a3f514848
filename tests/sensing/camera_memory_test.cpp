// What a learned camera remembers of the subjects that it has seen.
#include <cmath>
#include <functional>
#include <optional>
#include <tuple>

#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"
#include "sensing/camera_world.h"
#include "sensing/learned_camera.h"

namespace mrose {
namespace {

/// Subjects are numbered landmarks first, then robots, and 32 of them have a slot of the camera's memory.
constexpr std::size_t remembered = std::tuple_size_v<decltype(LearnedCamera::Memory::slots)>;

/// Whose errors last, and whether there is a reading.
SensorNetwork lastingNetwork() {
    SensorNetwork network = cameraNetwork({.threshold = 1, .rangeSpread = 0.05, .bearingSpread = 0.02});
    network.noise[0] = {0, 0, 1, 0.9, 5};
    network.noise[1] = network.noise[2] = {0, 0, 1, 0.9, 1000};
    return network;
}

/// Posts before the camera where `inView` says so; the others, and no robots, are behind it.
SmallWorld postsAhead(std::size_t count, const std::function<bool(std::size_t)>& inView) {
    std::vector<Obstacle> all;
    for (std::size_t i = 0; i < count; ++i) {
        const double aside = 0.03 * static_cast<double>(i) - 0.5;
        all.push_back(post(std::to_string(i), {inView(i) ? 2.0 : -2.0, aside}, 0.01));
    }
    return filmed(cameraOf(lastingNetwork()), std::move(all));
}

/// What is reported of one landmark, by look.
std::vector<std::optional<Point>> readingsOf(const std::vector<CameraLook>& looks, std::uint32_t landmark) {
    std::vector<std::optional<Point>> all;
    for (const CameraLook& look : looks) {
        const auto found = std::ranges::find(look.landmarks, landmark, &SeenBody::index);
        all.push_back(found == look.landmarks.end() ? std::nullopt : std::optional(found->position_B));
    }
    return all;
}

TEST(LearnedCameraMemory, SubjectsWhoseNumbersShareASlotDoNotDisturbEachOther) {
    constexpr std::uint32_t one = 3, other = one + remembered;
    const auto both =
        looks(postsAhead(other + 1, [](std::size_t i) { return i == one || i == other; }).scenario(), 2000);
    for (const std::uint32_t landmark : {one, other}) {
        const auto alone = looks(postsAhead(other + 1, [&](std::size_t i) { return i == landmark; }).scenario(), 2000);
        const auto readings = readingsOf(both, landmark);
        EXPECT_EQ(readings, readingsOf(alone, landmark)) << landmark;
        // Of neighbouring looks: half the mean square of the difference is what does not last.
        const double range = std::hypot(2, 0.03 * landmark - 0.5);
        double differences = 0;
        int pairs = 0;
        for (std::size_t k = 1; k < readings.size(); ++k) {
            if (!readings[k] || !readings[k - 1]) continue;
            const double change = (length(*readings[k]) - length(*readings[k - 1])) / 0.05;
            EXPECT_LT(std::abs(length(*readings[k]) - range), 0.3);
            differences += change * change;
            ++pairs;
        }
        ASSERT_GT(pairs, 200);
        EXPECT_NEAR(differences / (2 * pairs), 0.1 + 0.9 * (1 - std::exp(-0.236 / 1000)), 0.02) << landmark;
    }
}

/// Of more than it remembers, the first keep what they have.
TEST(LearnedCameraMemory, MoreSubjectsInViewThanItRemembersTakeNothingFromTheFirst) {
    const auto few = looks(postsAhead(remembered + 3, [](std::size_t i) { return i < remembered; }).scenario(), 300),
               all = looks(postsAhead(remembered + 3, [](std::size_t) { return true; }).scenario(), 300);
    std::size_t reportedBeyond = 0;
    for (std::uint32_t landmark = 0; landmark < remembered + 3; ++landmark) {
        const auto readings = readingsOf(all, landmark);
        if (landmark < remembered)
            EXPECT_EQ(readings, readingsOf(few, landmark)) << landmark;
        else
            reportedBeyond +=
                static_cast<std::size_t>(std::ranges::count_if(readings, [](const auto& r) { return r.has_value(); }));
    }
    EXPECT_NEAR(static_cast<double>(reportedBeyond) / 900, normalProbability(1), 0.06);
}

/// What is out of view longest makes room.
TEST(LearnedCameraMemory, RemembersThoseThatWereInViewLast) {
    LearnedCamera::Memory memory;
    for (std::uint32_t subject = 0; subject < remembered; ++subject) {
        ASSERT_EQ(memory.find(subject), nullptr);
        memory.take(subject, 100)->looked = 100 - 10 * (subject == 7) - 20 * (subject == 9);
    }
    EXPECT_EQ(memory.find(5), &memory.slots[5]);
    ASSERT_EQ(memory.take(5 + remembered, 100), &memory.slots[9]);
    memory.slots[9].looked = 100;
    EXPECT_EQ(memory.find(9), nullptr);
    EXPECT_EQ(memory.find(5 + remembered), &memory.slots[9]);
    ASSERT_EQ(memory.take(9, 100), &memory.slots[7]);
    memory.slots[7].looked = 100;
    EXPECT_EQ(memory.take(7, 100), nullptr) << "all are in view";
    EXPECT_EQ(memory.take(7, 101), &memory.slots[0]) << "the first of those that were at the last look";
}

}  // namespace
}  // namespace mrose
