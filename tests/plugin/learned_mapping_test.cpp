// What was learned is called by plug-ins: named by the scenario, carried by its value, the same in a process apart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/toml_text.h"
#include "learning/network_file.h"
#include "learning/reference_network.h"
#include "plugin/isolated_controller.h"
#include "plugin/load_plugin.h"
#include "plugin/network_mapping.h"
#include "plugin/test_plugins.h"
#include "scenario/descriptions.h"
#include "support/observation_parts.h"

namespace mrose {
namespace {

using testing::HasSubstr;

LearnedNetwork gain(const std::string& kind = "task") {
    LearnedNetwork network;
    network.kind = kind;
    network.inputs = {{"turned", "rad", 0.5, 2}, {"speed", "m/s", 0.1, 0.25}};
    network.outputs = {{"speed", "m/s", 0.3, 0.125}};
    network.regressor = test::normalNetwork({2, 5, 1}, 3);
    network.training.method = "irprop+";
    network.training.loss = "one-step";
    return network;
}

std::string textOf(const LearnedNetwork& network) { return networkFileText(network, '[' + network.kind + "]\n"); }

std::string optionsWith(const std::string& text) {
    return tomlText(Value::Table{{mappingsKey, Value::Table{{"gain", text}}}});
}

double expected(double turned, double speed) {
    const Mlp network = std::get<Mlp>(gain().regressor);
    const std::vector<double> parameters(network.parameters.begin(), network.parameters.end());
    const double x[] = {(turned - 0.5) / 2, (speed - 0.1) / 0.25};
    return 0.3 + 0.125 * test::referenceOutputs(network.shape, parameters, x)[0];
}

TEST(LearnedMapping, IsTheFormulaOfItsFile) {
    const auto mapping = parseMapping(textOf(gain()), "gain.net");
    ASSERT_TRUE(mapping) << mapping.error().message();
    ASSERT_EQ(mapping->inputs(), 2u);
    ASSERT_EQ(mapping->outputs(), 1u);
    EXPECT_STREQ(mapping->input(1).name, "speed");
    EXPECT_STREQ(mapping->output(0).unit, "m/s");
    for (const double turned : {-1.0, 0.0, 2.5}) {
        double out = 0;
        mapping->evaluate(std::array{turned, 0.4}, std::span(&out, 1));
        EXPECT_NEAR(out, expected(turned, 0.4), 1e-6);
    }
    double out = 0;
    EXPECT_THROW(mapping->evaluate(std::array{1.0}, std::span(&out, 1)), std::invalid_argument);
    EXPECT_THROW(mapping->evaluate(std::array{1.0, 1.0}, {}), std::invalid_argument);
    EXPECT_THAT(parseMapping(textOf(gain("motion")), "gain.net").error().message(), HasSubstr("\"motion\""));
}

double speedOf(const Controller& controller) {
    std::vector<std::byte> memory(controller.memorySize());
    controller.start(memory);
    Decision decision;
    ObservationParts observation;
    observation.velocity.w = 0.25;
    controller.decide(observation, memory, decision);
    EXPECT_EQ(decision.fault, "");
    return decision.command ? decision.command->v : 0;
}

TEST(LearnedMapping, PluginCallsItHereAndApart) {
    const std::string options = "speed_mps = 0.7\n" + optionsWith(textOf(gain()));
    const auto here = loadPlugin(testPlugin("well_behaved"), options);
    ASSERT_TRUE(here) << here.error().message();
    const auto apart = isolatePlugin(testPlugin("well_behaved"), options, isolation());
    ASSERT_TRUE(apart) << apart.error().message();
    const double speed = speedOf(**here);
    EXPECT_NEAR(speed, expected(0.25, 0.7), 1e-6);
    EXPECT_EQ(speedOf(**apart), speed);
    EXPECT_EQ(speedOf(**loadPlugin(testPlugin("well_behaved"), "speed_mps = 0.7\n")), 0.7);
}

TEST(LearnedMapping, WhatIsWrongIsSaid) {
    const auto errorOf = [](const std::string& options) {
        const auto loaded = loadPlugin(testPlugin("well_behaved"), options);
        return loaded ? "" : loaded.error().message();
    };
    EXPECT_THAT(errorOf(optionsWith(textOf(gain("motion")))),
                HasSubstr("mappings.gain: is no network of a task: line 4: kind: is a network of another"));
    EXPECT_THAT(errorOf(optionsWith("x")), HasSubstr("mappings.gain: is no network of a task: "));
    EXPECT_THAT(errorOf(tomlText(Value::Table{{mappingsKey, Value::Table{{"again", "x"}}}})),
                HasSubstr("mappings.again: is not a known key"));
}

/// The scenario's own robot "two" as a plug-in with a mapping.
std::map<std::string, std::string> worldWith(const std::string& mappings) {
    auto world =
        changedWorld("s.toml", "{ kind = \"wander\", speed_mps = 0.2, rotation_degps = 45, change_every_s = 1 }",
                     "{ kind = \"plugin\", library = \"" + testPlugin("well_behaved") + "\", " + mappings + " }");
    world["gain.net"] = textOf(gain());
    world["motion.net"] = textOf(gain("motion"));
    return world;
}

TEST(LearnedMapping, ScenarioNamesItsFileAndCarriesIt) {
    auto loaded = loadFrom(worldWith("mappings = { gain = \"gain.net\" }"));
    ASSERT_TRUE(loaded) << loaded.error().message();
    ScenarioLoading loading;
    std::string given;
    loading.plugins = [&](const std::string& path, const std::string& options) {
        given = options;
        return loadPlugin(path, options);
    };
    const auto again = loadScenario(loaded->value, loading);  // from the value alone
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(given, optionsWith(textOf(gain())));
}

/// In the order of the environment's obstacles, whose places cameras report.
TEST(PluginLandmarks, AreNamedByTheirPlaces) {
    auto world = worldWith("options = { label = \"count\" }");
    world["e.toml"] +=
        "[[obstacle]]\nlandmark = \"z 2\"\ncircle = { centre_m = [-4, 2], radius_m = 0.1 }\n"
        "[[obstacle]]\nlandmark = \"a\"\ncircle = { centre_m = [4, -2], radius_m = 0.1 }\n";
    ScenarioLoading loading;
    std::shared_ptr<const Controller> loaded;
    loading.plugins = [&](const std::string& path, const std::string& options) {
        auto plugin = loadPlugin(path, options);
        if (plugin) loaded = *plugin;
        return plugin;
    };
    KeptDescriptions source(world);
    const auto scenario = loadScenario("s.toml", source, loading);
    ASSERT_TRUE(scenario) << scenario.error().message();
    std::vector<std::byte> memory(loaded->memorySize());
    loaded->start(memory);
    EXPECT_EQ(explained(*loaded, memory).back().text, "z 2<a>");
    world["s.toml"].replace(world["s.toml"].find("label ="), 7, "landmarks =");
    KeptDescriptions other(world);
    const auto refused = loadScenario("s.toml", other, loading);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), HasSubstr("controller.options.landmarks: are the environment's"));
}

TEST(LearnedMapping, ScenarioSaysWhereItsMappingIsWrong) {
    ScenarioLoading loading;
    loading.plugins = [](const std::string& path, const std::string& options) { return loadPlugin(path, options); };
    const auto errorOf = [&](const std::string& mappings) -> std::string {
        const auto loaded = loadFrom(worldWith(mappings));
        if (!loaded) return loaded.error().message();
        const auto again = loadScenario(loaded->value, loading);
        return again ? "" : again.error().message();
    };
    EXPECT_THAT(errorOf("mappings = { gain = \"none.net\" }"),
                HasSubstr("controller.mappings.gain: \"none.net\" was not found"));
    EXPECT_THAT(errorOf("mappings = { gain = \"motion.net\" }"),
                HasSubstr("controller.mappings.gain: is no network of a task"));
    EXPECT_THAT(errorOf("mappings = { gian = \"gain.net\" }"),
                HasSubstr("controller.mappings.gian: is not a known key"));
    EXPECT_THAT(errorOf("options = { mappings = 1 }"), HasSubstr("controller.options.mappings: stands beside"));
}

}  // namespace
}  // namespace mrose
