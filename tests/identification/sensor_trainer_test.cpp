// Learned sensors, from samples whose distribution is known.
#include "identification/sensor_trainer.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "geometry/normal_distribution.h"
#include "identification/reading_noise_fit.h"
#include "perception/learned_sensor.h"
#include "world/noise.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// What the planted camera does of a state.
struct PlantedReading {
    double threshold, mean[2], spread[2];
};
PlantedReading plantedReading(const SensedState& s, int robot) {
    return {0.8 - 0.4 * s.range,
            {0.05 * s.range + (robot == 0 ? 0.1 : -0.1), 0.02 * s.velocity.w},
            {0.02 + 0.01 * s.range, 0.01}};
}

constexpr double lookPeriod = 0.25;  // s
const ReadingNoises plantedNoise{{{0.2, 0.15, 2, 0.3, 6}, {0.1, 0.2, 5, 0.2, 4}, {0.3, 0.2, 3, 0.1, 10}, {}}};

double plantedNormal(std::int64_t i, std::uint32_t part, std::uint32_t channel) {
    return normalNoise({7, i, part, channel});
}

/// Looks of two robots at four subjects whose places wander about, by the planted distribution and noise.
SensorSamples plantedSamples(int looks, const ReadingNoises& noises) {
    SensorSamples samples;
    samples.robots = {"a", "b"};
    const NoiseWeights weights(noises);
    constexpr std::size_t subjects = 4;
    for (int robot = 0; robot < 2; ++robot) {
        ChannelNumbers slow{};
        std::array<ChannelNumbers, subjects> own{};
        const auto step = [&](ChannelNumbers& numbers, std::int64_t look, std::uint32_t part, bool ofSubject) {
            for (std::uint32_t c = 0; c < 3; ++c) {
                const double time = ofSubject ? noises[c].subjectTime : noises[c].slowTime;
                const double draw = plantedNormal(look, part, c);
                numbers[c] = (look % looks == 0 ? Lasting{} : Lasting::after(lookPeriod, time)).next(numbers[c], draw);
            }
        };
        for (int l = 0; l < looks; ++l) {
            const std::int64_t look = robot * looks + l;
            SampledLook& added = samples.looks.emplace_back();
            added = {0,       robot, std::int64_t(l * lookPeriod * 1e9), int(l * lookPeriod / 60), samples.cases.size(),
                     subjects};
            step(slow, look, 100, false);
            const auto own0 = static_cast<std::uint32_t>(200);
            for (std::size_t k = 0; k < subjects; ++k) {
                const auto part = static_cast<std::uint32_t>(k);
                step(own[k], look, own0 + part, true);
                SensorCase one;
                one.subject = k;
                one.state.range = 1 + 4 * uniformNoise({8, look, part, 0});
                one.state.bearing = uniformNoise({8, look, part, 1}) - 0.5;
                one.state.velocity = {0, uniformNoise({8, look, 50, 0}) - 0.5};
                findEdges(one.state, {6, 1.2});
                const PlantedReading planted = plantedReading(one.state, robot);
                ChannelNumbers z;
                for (std::uint32_t c = 0; c < 3; ++c)
                    z[c] = weights.look[c] * plantedNormal(look, 300, c) + weights.slow[c] * slow[c] +
                           weights.subject[c] * own[k][c] + weights.alone[c] * plantedNormal(look, 400 + part, c);
                one.reported = z[0] < planted.threshold;
                if (one.reported)
                    for (std::size_t d = 0; d < 2; ++d) one.error[d] = planted.mean[d] + planted.spread[d] * z[1 + d];
                samples.cases.push_back(one);
            }
        }
    }
    return samples;
}

SensorNetwork cameraBlueprint() {
    SensorNetwork network;
    network.sensor = "camera";
    network.view = {6, 1.2};
    network.robotSubjects = true;
    return network;
}

SensorTrainerOptions quickly(RegressorFamily family) {
    SensorTrainerOptions options;
    options.family = family;
    options.components = 1;
    options.reported = {.hidden = 6, .epochs = 150, .weightDecay = 1e-4, .folds = 2};
    options.error = {.hidden = 6, .epochs = 300, .weightDecay = 1e-4, .folds = 2};
    return options;
}

class SensorTraining : public testing::TestWithParam<RegressorFamily> {};

TEST_P(SensorTraining, FindsThePlantedDistribution) {
    const SensorSamples samples = plantedSamples(2000, {});
    const auto trained = trainSensor(cameraBlueprint(), samples, quickly(GetParam()));
    ASSERT_TRUE(trained) << trained.error().message();
    const LearnedSensor sensor((*trained));
    double chance = 0, mean[2] = {}, spread[2] = {};
    const std::size_t count = 1000;
    for (std::size_t i = 0; i < count; ++i) {
        const SampledLook& look = samples.looks[4 * i % samples.looks.size()];
        const SensedState& state = samples.cases[look.first].state;
        const PlantedReading planted = plantedReading(state, look.robot);
        ReadingDistribution found;
        sensor.distributions({&state, 1}, look.robot, {&found, 1});
        chance += std::abs(found.probability() - normalProbability(planted.threshold)) / count;
        for (int d = 0; d < 2; ++d) {
            mean[d] += std::abs(found.component[0].mean[d] - planted.mean[d]) / planted.spread[d] / count;
            spread[d] += std::abs(std::log(found.component[0].spread[d] / planted.spread[d])) / count;
        }
    }
    EXPECT_LT(chance, 0.07);
    for (int d = 0; d < 2; ++d) {
        EXPECT_LT(mean[d], 0.4) << "in standard deviations";
        EXPECT_LT(spread[d], 0.25);
    }
    // what is learned comes close to what no model can be better than
    double best = 0;
    for (const SampledLook& look : samples.looks)
        for (std::size_t i = 0; i < look.count; ++i) {
            const SensorCase& one = samples.cases[look.first + i];
            const double p = normalProbability(plantedReading(one.state, look.robot).threshold);
            best += std::log(one.reported ? p : 1 - p) / static_cast<double>(samples.cases.size());
        }
    EXPECT_GT(trained->heldOut.reported, best - 0.03);
    EXPECT_LT(trained->heldOut.reported, best + 0.01);
}

std::string familyName(const testing::TestParamInfo<RegressorFamily>& info) { return std::string(nameOf(info.param)); }
INSTANTIATE_TEST_SUITE_P(Families, SensorTraining,
                         testing::Values(RegressorFamily::network, RegressorFamily::table, RegressorFamily::trees),
                         familyName);

TEST(SensorTraining, GivesTheSameNetworkOnAnyNumberOfThreads) {
    const SensorSamples samples = plantedSamples(600, plantedNoise);
    for (const RegressorFamily family : {RegressorFamily::network, RegressorFamily::table, RegressorFamily::trees}) {
        SensorTrainerOptions options = quickly(family);
        options.reported.epochs = options.error.epochs = 20;
        options.trees = 3;
        const auto textOn = [&](int threads) {
            tbb::task_arena arena(threads);
            return arena.execute([&] { return sensorText(*trainSensor(cameraBlueprint(), samples, options)); });
        };
        EXPECT_EQ(textOn(1), textOn(3)) << nameOf(family);
    }
}

TEST(SensorTraining, FindsWhatReadingsHaveInCommon) {
    const SensorSamples samples = plantedSamples(12000, plantedNoise);
    // The planted distribution itself, so that nothing of the noise is taken for something else.
    SensorNetwork network = cameraBlueprint();
    network.robots = samples.robots;
    network.learned.inputs = {{"range", "m"}, {"rotation", "rad/s"}, {"robot a", "1"}, {"robot b", "1"}};
    network.learned.outputs = sensorOutputs(network.measures, network.form);
    // tanh of so little is linear
    constexpr float small = 1e-3f;
    network.learned.regressor = Mlp{{4, 3, 5},
                                    {small,
                                     0,
                                     0,
                                     0,
                                     0,
                                     small,
                                     0,
                                     0,
                                     0,
                                     0,
                                     small,
                                     -small,
                                     0,
                                     0,
                                     0,  // hidden
                                     -0.4f / small,
                                     0,
                                     0,
                                     0.05f / small,
                                     0,
                                     0.1f / small,
                                     0,
                                     0.02f / small,
                                     0,  // report, errors
                                     0,
                                     0,
                                     0,
                                     0,
                                     0,
                                     0,  // spreads
                                     0.8f,
                                     0,
                                     0,
                                     std::log(0.05f),
                                     std::log(0.01f)}};
    SensorSamples even = samples;  // of a spread that does not depend on the range
    for (const SampledLook& look : even.looks)
        for (std::size_t i = 0; i < look.count; ++i) {
            SensorCase& one = even.cases[look.first + i];
            const PlantedReading planted = plantedReading(one.state, look.robot);
            one.error[0] = planted.mean[0] + 0.05 * (one.error[0] - planted.mean[0]) / planted.spread[0];
        }
    const ReadingNoises found = fitReadingNoises(LearnedSensor(network), even);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(found[c].look, plantedNoise[c].look, 0.05) << c;
        EXPECT_NEAR(found[c].slow, plantedNoise[c].slow, 0.05) << c;
        EXPECT_NEAR(found[c].subject, plantedNoise[c].subject, 0.06) << c;
        EXPECT_NEAR(std::log(found[c].subjectTime / plantedNoise[c].subjectTime), 0, 0.4) << c;
    }
    const ReadingNoises none = fitReadingNoises(LearnedSensor(network), [&] {
        SensorSamples independent = plantedSamples(12000, {});
        for (const SampledLook& look : independent.looks)
            for (std::size_t i = 0; i < look.count; ++i) {
                SensorCase& one = independent.cases[look.first + i];
                const PlantedReading planted = plantedReading(one.state, look.robot);
                one.error[0] = planted.mean[0] + 0.05 * (one.error[0] - planted.mean[0]) / planted.spread[0];
            }
        return independent;
    }());
    for (std::size_t c = 0; c < 3; ++c) EXPECT_GT(none[c].alone(), 0.93) << c;
}

// So little is nearer that a network without an edge there goes on with what it has learned beyond.
TEST(SensorTraining, FindsThatWhatIsNearestIsNotReported) {
    SensorSamples samples = plantedSamples(2000, {});
    SensorNetwork blueprint = cameraBlueprint();
    blueprint.view.nearest = 1;
    std::size_t i = 0;
    for (SensorCase& one : samples.cases) {
        if (i++ % 150 == 0) {
            one.state.range = 0.7 + 0.25 * uniformNoise({9, static_cast<std::int64_t>(i), 0, 0});
            one.reported = false;
        }
        findEdges(one.state, blueprint.view);
    }
    const auto trained = trainSensor(blueprint, samples, quickly(RegressorFamily::network));
    ASSERT_TRUE(trained) << trained.error().message();
    const LearnedSensor sensor(*trained);
    const auto chanceAt = [&](double range) {
        SensedState state;
        state.range = range;
        findEdges(state, blueprint.view);
        ReadingDistribution found;
        sensor.distributions({&state, 1}, 0, {&found, 1});
        return found.probability();
    };
    EXPECT_LT(chanceAt(0.8), 0.1);
    EXPECT_NEAR(chanceAt(1.2), normalProbability(0.8 - 0.4 * 1.2), 0.1);
}

TEST(SensorTraining, CountsGrossErrors) {
    SensorSamples samples = plantedSamples(2000, {});
    std::size_t wrong = 0, readings = 0;
    for (SensorCase& one : samples.cases)
        if (one.reported && readings++ % 200 == 0) one.error[0] += 5, ++wrong;
    SensorTrainerOptions options = quickly(RegressorFamily::network);
    options.reported.epochs = options.error.epochs = 20;
    const auto trained = trainSensor(cameraBlueprint(), samples, options);
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_NEAR(trained->gross.share * static_cast<double>(readings), static_cast<double>(wrong), 1);
    EXPECT_GT(trained->gross.reach[0], 4.5);
}

SensorTrainerOptions atOnce(RegressorFamily family) {
    SensorTrainerOptions options = quickly(family);
    options.reported.epochs = options.error.epochs = 60;
    options.trees = 3;
    return options;
}

TEST(SensorTraining, ABiasIsNoGrossError) {
    SensorSamples samples = plantedSamples(2000, {});
    for (SensorCase& one : samples.cases) one.error[0] += 5;
    for (const RegressorFamily family : {RegressorFamily::network, RegressorFamily::table, RegressorFamily::trees}) {
        const auto trained = trainSensor(cameraBlueprint(), samples, atOnce(family));
        ASSERT_TRUE(trained) << trained.error().message();
        EXPECT_LT(trained->gross.share, 1e-3) << nameOf(family);
        ReadingDistribution found;
        LearnedSensor(*trained).distributions({&samples.cases[0].state, 1}, 0, {&found, 1});
        EXPECT_NEAR(found.mean(0), 5, 0.5) << nameOf(family);
    }
}

TEST(SensorTraining, ASensorWithoutAnyErrorGivesAFileThatCanBeRead) {
    SensorSamples samples = plantedSamples(600, {});
    for (SensorCase& one : samples.cases) one.error = {}, one.reported = true;
    for (const RegressorFamily family : {RegressorFamily::network, RegressorFamily::table, RegressorFamily::trees}) {
        const auto trained = trainSensor(cameraBlueprint(), samples, atOnce(family));
        ASSERT_TRUE(trained) << trained.error().message();
        const auto read = parseSensor(sensorText(*trained), "exact.net");
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(*read, *trained);
    }
}

TEST(SensorTraining, BlocksMayHaveNegativeNumbers) {
    const SensorSamples samples = plantedSamples(600, {});
    SensorSamples negative = samples;
    for (SampledLook& look : negative.looks) look.block -= 10;
    const auto options = atOnce(RegressorFamily::network);
    const auto a = trainSensor(cameraBlueprint(), samples, options);
    const auto b = trainSensor(cameraBlueprint(), negative, options);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(sensorText(*a), sensorText(*b)) << "ten is a multiple of the folds";
}

TEST(SensorTraining, RefusesMoreRobotsThanCanBeToldApart) {
    SensorSamples samples = plantedSamples(600, {});
    for (int i = 0; i < 300; ++i) samples.robots.push_back("other" + std::to_string(i));
    const auto trained = trainSensor(cameraBlueprint(), samples, atOnce(RegressorFamily::network));
    ASSERT_FALSE(trained);
    EXPECT_THAT(trained.error().message(), HasSubstr("holds 302 robots; at most 241 can be told apart"));
}

TEST(SensorTraining, SaysWhatIsTooLittle) {
    const auto few = trainSensor(cameraBlueprint(), plantedSamples(40, {}), quickly(RegressorFamily::network));
    ASSERT_FALSE(few);
    EXPECT_THAT(few.error().message(), HasSubstr("learning needs 200"));
    const auto shortOnes = trainSensor(cameraBlueprint(), plantedSamples(200, {}), quickly(RegressorFamily::network));
    ASSERT_FALSE(shortOnes) << "all of it is one block of time";
    EXPECT_THAT(shortOnes.error().message(), HasSubstr("too short"));
}

TEST(SensorTraining, EndsWhenItIsToldTo) {
    const auto trained = trainSensor(cameraBlueprint(), plantedSamples(600, {}), quickly(RegressorFamily::network),
                                     [](double share) { return share < 0.3; });
    ASSERT_FALSE(trained);
    EXPECT_THAT(trained.error().message(), HasSubstr("cancelled"));
}

}  // namespace
}  // namespace mrose
