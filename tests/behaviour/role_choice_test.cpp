#include "behaviour/role_choice.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "behaviour/small_field.h"

namespace mrose {
namespace {

constexpr Nanoseconds slot = RoleChoice::slotLength;
constexpr double cannot = std::numeric_limits<double>::infinity();

RoleChoice::Bid offer(Nanoseconds told, double cost, bool goes = false) {
    return {told, cost, goes ? RoleChoice::goes : RoleChoice::offers};
}

/// Players that tell each other their costs at each slot, each somewhat later than the one before, and hear it `late`
/// nanoseconds later at the earliest; `loses(from, to, slot)` is never heard.
class Talk {
public:
    Talk(std::size_t players, RoleChoice::Options options, Nanoseconds late)
        : choices_(players), options_(options), late_(late) {}

    template <class CostOf, class Loses>
    void run(std::int64_t slots, CostOf costOf, Loses loses) {
        for (std::int64_t k = 0; k < slots; ++k)
            for (std::size_t i = 0; i < choices_.size(); ++i) {
                const Nanoseconds now = k * slot + static_cast<Nanoseconds>(i) * slot / 8;
                for (const Said& said : said_)
                    if (said.from != i && said.bid.told + late_ <= now && said.bid.told + late_ + slot > now &&
                        !loses(said.from, i, RoleChoice::slotOf(said.bid.told)))
                        choices_[i].note(said.from, said.bid);
                const auto own = static_cast<std::int64_t>(i) + 1;
                const RoleChoice::Bid before = offer(now, costOf(i, k), choices_[i].goer == own);
                choices_[i].note(i, before);
                choices_[i].choose(now, options_);
                const RoleChoice::Bid after = offer(now, before.cost, choices_[i].goer == own);
                choices_[i].note(i, after);
                said_.push_back({i, after});
                if (i + 1 == choices_.size()) count();
            }
    }
    /// As it was chosen before.
    void choose(std::span<const std::int64_t> goers) {
        for (std::size_t i = 0; i < goers.size(); ++i) choices_[i].goer = goers[i];
    }
    std::int64_t none() const { return none_; }
    std::int64_t one() const { return one_; }
    std::int64_t more() const { return more_; }
    const std::vector<RoleChoice>& choices() const { return choices_; }

private:
    struct Said {
        std::size_t from;
        RoleChoice::Bid bid;
    };
    void count() {
        int go = 0;
        for (std::size_t i = 0; i < choices_.size(); ++i)
            go += choices_[i].goer == static_cast<std::int64_t>(i) + 1 ? 1 : 0;
        ++(go == 0 ? none_ : go == 1 ? one_ : more_);
    }

    std::vector<RoleChoice> choices_;
    RoleChoice::Options options_;
    Nanoseconds late_;
    std::vector<Said> said_;
    std::int64_t none_ = 0, one_ = 0, more_ = 0;
};

const auto losesNothing = [](std::size_t, std::size_t, std::int64_t) { return false; };

TEST(RoleChoice, TheCheapestGoesAndEqualCostsGoToTheFirst) {
    RoleChoice choice{};
    const RoleChoice::Options atOnce{.hysteresis = 0, .agree = 0};
    choice.note(0, offer(0, 4));
    choice.note(1, offer(0, 3));
    choice.note(2, offer(0, 3));
    choice.choose(0, atOnce);
    EXPECT_EQ(choice.goer, 2);
    choice.note(2, offer(slot, 2.9));
    choice.choose(slot, atOnce);
    EXPECT_EQ(choice.goer, 3);
    EXPECT_EQ(choice.switches, 1);
}

TEST(RoleChoice, WhoGoesKeepsGoingUntilAnotherIsBetterByTheHysteresis) {
    RoleChoice choice{};
    const RoleChoice::Options options{.hysteresis = 1, .agree = 0};
    std::int64_t k = 0;
    const auto costs = [&](double first, double second) {
        const Nanoseconds now = ++k * slot;
        choice.note(0, offer(now, first, choice.goer == 1));
        choice.note(1, offer(now, second, choice.goer == 2));
        choice.choose(now, options);
        return choice.goer;
    };
    EXPECT_EQ(costs(3, 4), 1);
    EXPECT_EQ(costs(3, 2.1), 1);
    EXPECT_EQ(costs(3, 1.9), 2);
    EXPECT_EQ(costs(1.1, 1.9), 2);
    EXPECT_EQ(costs(0.8, 1.9), 1);
}

TEST(RoleChoice, WhoCannotGoOrIsNotHeardIsOutOfIt) {
    RoleChoice choice{};
    const RoleChoice::Options options{.hysteresis = 5, .agree = 0, .forget = 4};
    choice.note(0, offer(0, 1));
    choice.note(1, offer(0, cannot));
    choice.choose(0, options);
    EXPECT_EQ(choice.goer, 1);
    for (std::int64_t k = 1; k <= 4; ++k) {
        choice.note(1, offer(k * slot, 9));
        choice.choose(k * slot, options);
        EXPECT_EQ(choice.goer, 1) << k;
    }
    choice.note(1, offer(5 * slot, 9));
    choice.choose(5 * slot, options);
    EXPECT_EQ(choice.goer, 2);
    // Where nobody can, who went goes on.
    choice.note(1, offer(6 * slot, cannot, true));
    choice.choose(6 * slot, options);
    EXPECT_EQ(choice.goer, 2);
}

TEST(RoleChoice, OfASlotTheLastBidCountsWhateverTheOrderInWhichTheyAreHeard) {
    RoleChoice choice{};
    for (const Nanoseconds told : {3 * slot, slot + 10, 2 * slot, slot + 20, slot})
        choice.note(0, offer(told, static_cast<double>(told)));
    const auto& bids = choice.bids[0];
    ASSERT_EQ(choice.newest(0)->told, 3 * slot);
    EXPECT_EQ(bids[1].told, 2 * slot);
    EXPECT_EQ(bids[2].told, slot + 20);
    EXPECT_EQ(bids[3].says, RoleChoice::nothing);
    EXPECT_FALSE(choice.newest(1));
}

/// Costs that cross and tremble. What all have heard they choose alike, at every slot.
const auto tremblingCosts = [](std::size_t player, std::int64_t k) {
    const double wave = std::abs(std::remainder(static_cast<double>(k) + 17.0 * static_cast<double>(player), 60.0)) / 6;
    return wave + draw(5, k, static_cast<std::uint32_t>(player), -0.4, 0.4);
};

TEST(RoleChoice, AllChooseAlikeWhoHearEachOtherInTime) {
    for (const double hysteresis : {0.0, 1.0}) {
        Talk talk(4, {.hysteresis = hysteresis, .agree = 2}, slot - 1);
        talk.run(600, tremblingCosts, losesNothing);
        EXPECT_EQ(talk.one(), 598) << "all but the first two, when nobody knows anything";
        EXPECT_EQ(talk.more(), 0);
        EXPECT_GT(talk.choices()[0].switches, 20);
    }
    // Who chooses by what it has just heard, and by its own cost of now, chooses otherwise than the others.
    Talk hasty(4, {.hysteresis = 0, .agree = 0}, slot - 1);
    hasty.run(600, tremblingCosts, losesNothing);
    EXPECT_GT(hasty.none() + hasty.more(), 30);
}

TEST(RoleChoice, HysteresisLeavesFewerSwitches) {
    std::int64_t before = 1000;
    for (const double hysteresis : {0.0, 0.5, 2.0}) {
        Talk talk(3, {.hysteresis = hysteresis, .agree = 2}, slot - 1);
        talk.run(600, tremblingCosts, losesNothing);
        const std::int64_t switches = talk.choices()[0].switches;
        EXPECT_LT(switches, before) << hysteresis;
        before = switches;
    }
}

/// Nobody knows the ball, and each takes another for the one that goes.
TEST(RoleChoice, WhereNobodyCanGoChoicesThatDifferBecomeOneAgain) {
    const auto nobodyCan = [](std::size_t, std::int64_t) { return cannot; };
    for (const std::array<std::int64_t, 3>& goers : {std::array<std::int64_t, 3>{2, 3, 1}, {1, 2, 3}, {2, 1, 0}}) {
        Talk talk(3, {.hysteresis = 1, .agree = 2}, slot - 1);
        talk.choose(goers);
        talk.run(20, nobodyCan, losesNothing);
        EXPECT_GE(talk.one(), 12);
        for (const RoleChoice& choice : talk.choices()) EXPECT_EQ(choice.goer, talk.choices()[0].goer);
        EXPECT_NE(talk.choices()[0].goer, 0);
    }
}

/// A third of the messages is lost: they differ now and then, and become one again.
TEST(RoleChoice, ChoicesThatDifferBecomeOneAgain) {
    Talk talk(4, {.hysteresis = 1, .agree = 2}, slot - 1);
    talk.run(600, tremblingCosts, [](std::size_t from, std::size_t to, std::int64_t k) {
        return draw(6, k, static_cast<std::uint32_t>(10 * from + to), 0, 1) < 0.3;
    });
    EXPECT_GT(talk.one(), 500);
    // Two that were apart for long and both think that they go.
    Talk apart(2, {.hysteresis = 1, .agree = 2}, slot - 1);
    const auto costs = [](std::size_t player, std::int64_t) { return 3 + 0.5 * static_cast<double>(player); };
    apart.run(100, costs, [](std::size_t, std::size_t, std::int64_t k) { return k < 50; });
    EXPECT_EQ(apart.choices()[0].goer, 1);
    EXPECT_EQ(apart.choices()[1].goer, 1);
    EXPECT_GT(apart.more(), 40);
    EXPECT_LT(apart.more(), 60);
}

}  // namespace
}  // namespace mrose
