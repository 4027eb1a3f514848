#include "learning/ensemble.h"

#include <gtest/gtest.h>

#include "learning/mlp_inference.h"
#include "learning/reference_network.h"

namespace mrose {
namespace {

std::vector<Mlp> networks(std::size_t count) {
    std::vector<Mlp> made;
    for (std::size_t i = 0; i < count; ++i)
        made.push_back(test::normalNetwork({3, 4 + static_cast<int>(i), 2}, static_cast<unsigned>(i) + 1));
    return made;
}

std::vector<float> outputsOf(const Mlp& network, const std::vector<float>& x) {
    std::vector<float> y(static_cast<std::size_t>(network.shape.outputs));
    MlpInference(network).one(x.data(), y.data());
    return y;
}

TEST(Ensemble, GivesTheMeanOfItsMembersAsOneNetwork) {
    const std::vector<Mlp> members = networks(4);
    const Mlp mean = mergedMean(members);
    EXPECT_TRUE((mean.shape == MlpShape{3, 4 + 5 + 6 + 7, 2}));
    for (unsigned seed = 10; seed < 30; ++seed) {
        const std::vector<float> x = test::normalNumbers(3, seed);
        const std::vector<float> y = outputsOf(mean, x);
        for (std::size_t k = 0; k < 2; ++k) {
            double sum = 0;
            for (const Mlp& member : members) sum += outputsOf(member, x)[k];
            EXPECT_NEAR(y[k], sum / 4, 1e-5);
        }
    }
}

TEST(Ensemble, MembersOfAPowerOfTwoComeBackToTheBit) {
    for (const std::size_t count : {1u, 2u, 4u, 8u}) {
        const std::vector<Mlp> members = networks(count);
        const Mlp mean = mergedMean(members);
        const std::vector<EnsembleMember> known = membersOf(members);
        for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(memberOf(mean, known, i), members[i]) << count;
    }
}

TEST(Ensemble, MembersOfAnyNumberComeBackWithinRounding) {
    const std::vector<Mlp> members = networks(3);
    const Mlp mean = mergedMean(members);
    const std::vector<EnsembleMember> known = membersOf(members);
    for (std::size_t i = 0; i < 3; ++i) {
        const Mlp again = memberOf(mean, known, i);
        ASSERT_EQ(again.shape, members[i].shape);
        for (std::size_t p = 0; p < again.parameters.size(); ++p)
            EXPECT_NEAR(again.parameters[p], members[i].parameters[p], 1e-6);
    }
}

/// As of a network whose further outputs were fitted to all hidden units.
TEST(Ensemble, AMemberHasOnlyTheOutputsThatAreMeans) {
    const std::vector<Mlp> members = networks(2);
    Mlp mean = mergedMean(members);
    const Mlp before = mean;
    std::vector<EnsembleMember> known = membersOf(members);
    const std::vector<float> weights = test::normalNumbers(9, 7), bias{0.5f};
    mean.parameters.insert(mean.parameters.end() - 2, weights.begin(), weights.end());
    mean.parameters.insert(mean.parameters.end(), bias.begin(), bias.end());
    mean.shape.outputs = 3;
    EXPECT_TRUE(isMeanOf(mean, known));
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(memberOf(mean, known, i), memberOf(before, known, i));
}

/// Outputs of the ensemble, then of its members.
std::vector<float> allOutputs(const Mlp& ensemble, const std::vector<Mlp>& members, const std::vector<float>& x) {
    return outputsOf(withMemberOutputs(ensemble, membersOf(members)), x);
}

TEST(Ensemble, OutputsOfMembersComeBesideTheMeanWhichStaysToTheBit) {
    for (const std::size_t count : {1u, 2u, 3u, 5u, 8u}) {
        const std::vector<Mlp> members = networks(count);
        const Mlp mean = mergedMean(members);
        for (unsigned seed = 10; seed < 30; ++seed) {
            const std::vector<float> x = test::normalNumbers(3, seed), all = allOutputs(mean, members, x);
            ASSERT_EQ(all.size(), 2 + 2 * count);
            EXPECT_EQ(std::vector<float>(all.begin(), all.begin() + 2), outputsOf(mean, x));
            for (std::size_t i = 0; i < count; ++i) {
                const std::vector<float> own = outputsOf(members[i], x);
                for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(all[2 + 2 * i + k], own[k], 1e-5) << count;
            }
        }
    }
}

/// So that no member's sum begins elsewhere.
TEST(Ensemble, OutputsOfMembersOfWholeFoursAreTheirsToTheBit) {
    std::vector<Mlp> members;
    for (const int hidden : {4, 24, 8, 12})
        members.push_back(test::normalNetwork({3, hidden, 2}, static_cast<unsigned>(hidden)));
    const std::vector<float> x = test::normalNumbers(3, 9), all = allOutputs(mergedMean(members), members, x);
    for (std::ptrdiff_t i = 0; i < 4; ++i)
        EXPECT_EQ(std::vector<float>(all.begin() + 2 + 2 * i, all.begin() + 4 + 2 * i),
                  outputsOf(members[static_cast<std::size_t>(i)], x))
            << i;
}

TEST(Ensemble, ThatIsNotMadeOfItsMembersIsToldApart) {
    const std::vector<Mlp> members = networks(2);
    const Mlp mean = mergedMean(members);
    const std::vector<EnsembleMember> known = membersOf(members);
    EXPECT_TRUE(isMeanOf(mean, known));
    EXPECT_FALSE(isMeanOf(mean, {}));
    const auto changed = [&](const auto& change) {
        std::vector<EnsembleMember> other = known;
        change(other);
        return isMeanOf(mean, other);
    };
    EXPECT_FALSE(changed([](auto& m) { m.pop_back(); })) << "units without a member";
    EXPECT_FALSE(changed([](auto& m) { ++m[0].hidden; }));
    EXPECT_FALSE(changed([](auto& m) { m[0].outputBiases.pop_back(); })) << "members of different outputs";
    EXPECT_FALSE(changed([](auto& m) { m[1].outputBiases[1] += 0.01f; })) << "another mean";
    EXPECT_FALSE(changed([](auto& m) {
        for (EnsembleMember& member : m) member.outputBiases.assign(3, 0);
    })) << "more outputs than the network has";
}

}  // namespace
}  // namespace mrose
