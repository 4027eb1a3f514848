// Sensors of robot files, with presets and without: what is read, and what is refused.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenario/description_file.h"
#include "scenario/descriptions.h"
#include "sensing/sensor.h"
#include "support/places.h"

namespace mrose {
namespace {

using testing::HasSubstr;

const std::string presetHead = "format = \"mrose sensor\"\nversion = 1\nname = \"Scanner\"\nsource = \"none\"\n";
const std::string scanner = presetHead + "kind = \"laser\"\nbeams = 5\nstart_deg = -20\nend_deg = 20\nrange_m = 4\n";

std::map<std::string, std::string> sensingWorld(const std::string& sensor, const std::string& preset = scanner) {
    auto texts = changedWorld("r.toml", "[kinematics]", "[[sensor]]\nname = \"s\"\n" + sensor + "[kinematics]");
    texts["scanner.toml"] = preset;
    return texts;
}

SensorPointer loadedSensor(const std::string& sensor, const std::string& preset = scanner) {
    const auto loaded = loadFrom(sensingWorld(sensor, preset));
    EXPECT_TRUE(loaded) << loaded.error().message();
    return loaded ? Scenario(loaded->parts).sensors(0)[3] : nullptr;
}

std::string sensorRefusal(const std::string& sensor, const std::string& preset = scanner) {
    const auto loaded = loadFrom(sensingWorld(sensor, preset));
    return loaded ? "" : loaded.error().message();
}

TEST(SensorPreset, ItsKeysHoldWhereTheRobotFileHasNone) {
    const SensorPointer plain = loadedSensor("preset = \"scanner.toml\"\n");
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->name(), "s");
    ASSERT_EQ(plain->elements().size(), 5u);
    EXPECT_EQ(plain->elements()[0].range, 4);
    const SensorPointer other =
        loadedSensor("preset = \"scanner.toml\"\nbeams = 9\nposition_m = [0.1, 0]\nperiod_s = 0.3\n");
    ASSERT_TRUE(other);
    ASSERT_EQ(other->elements().size(), 9u);
    EXPECT_EQ(other->elements()[8].mount.x, 0.1);
    EXPECT_NEAR(other->elements()[8].mount.heading, 20 * std::numbers::pi / 180, 1e-12);
    EXPECT_EQ(other->period(), 300'000'000);
}

/// A recording holds the scenario's value, without any file.
TEST(SensorPreset, IsInTheScenariosValue) {
    const auto loaded = loadFrom(sensingWorld("preset = \"scanner.toml\"\n"));
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_THAT(loaded->value.bytes(), HasSubstr("start_deg"));
    const auto again = loadScenario(loaded->value);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(Scenario(again->parts).sensors(0)[3]->elements().size(), 5u);
}

TEST(SensorPreset, AMistakeInItIsToldAsItsOwn) {
    const std::string named = "preset = \"scanner.toml\"\n";
    EXPECT_THAT(sensorRefusal(named, scanner + "beam = 3\n"), HasSubstr("scanner.toml:10:8: beam: is not a known key"));
    EXPECT_THAT(sensorRefusal(named, presetHead), HasSubstr("scanner.toml:1:1: kind: is missing"));
    EXPECT_THAT(sensorRefusal(named, "format = \"mrose sensor\"\nversion = 1\nname = \"a\"\nkind = \"laser\"\n"),
                HasSubstr("scanner.toml:1:1: source: is missing"));
    EXPECT_THAT(sensorRefusal(named, scanner + "preset = \"other.toml\"\n"), HasSubstr("preset: is not a known key"));
    EXPECT_THAT(sensorRefusal("preset = \"none.toml\"\n"),
                HasSubstr("sensor[\"s\"].preset: \"none.toml\" was not found"));
    EXPECT_THAT(
        sensorRefusal(named, presetHead + "kind = \"sonar\"\ncone_deg = 30\nring = { count = 4, radius_m = 3 }\n"),
        HasSubstr("sensor[\"s\"].ring: has an element that is at 3.000, 0.000, outside of the robot's shape (the "
                  "key is of scanner.toml)"));
    EXPECT_THAT(sensorRefusal("preset = \"disc.toml\"\n"), HasSubstr("disc.toml:1:10: format: is \"mrose shape\""));
    EXPECT_THAT(sensorRefusal(named + "beam = 3\n"), HasSubstr("r.toml"));
}

TEST(SensorFiles, WhatIsWrongIsOneLineWithFileLineAndKey) {
    const std::string laser = "kind = \"laser\"\nstart_deg = -90\nend_deg = 90\n";
    EXPECT_EQ(sensorRefusal(laser + "beams = 181\n"), "");
    for (const char* const beams : {"0", "1000000", "-1", "1.5"})
        EXPECT_THAT(
            sensorRefusal(laser + "beams = " + beams + "\n"),
            testing::MatchesRegex("r.toml:[0-9]+:9: sensor\\[\"s\"\\].beams: expected a whole number from 1 to 4096"));
    EXPECT_THAT(sensorRefusal("kind = \"laser\"\nstart_deg = -190\nend_deg = 180\nbeams = 10\n"),
                HasSubstr("sensor[\"s\"].end_deg: is 370.0 degrees from start_deg; expected up to 360"));
    EXPECT_THAT(sensorRefusal("kind = \"laser\"\nstart_deg = 10\nend_deg = 0\nbeams = 10\n"),
                HasSubstr("end_deg: is -10.0"));
    EXPECT_THAT(sensorRefusal(laser + "beams = 1\n"), HasSubstr("and 0 with a single beam alone"));
    EXPECT_THAT(sensorRefusal(laser + "beams = 2\nposition_m = [3.0, 0.0]\n"),
                HasSubstr("sensor[\"s\"].position_m: is at 3.000, 0.000, outside of the robot's shape"));
    EXPECT_THAT(sensorRefusal(laser + "beams = 2\nleast_range_m = 9\n"),
                HasSubstr("least_range_m: is 9.0; expected 0.0 to 8.0"));
    EXPECT_THAT(sensorRefusal(laser + "beams = 2\nlatency_s = 2\n"),
                HasSubstr("latency_s: is 2.0; expected 0.0 to 1.0"));
    const std::string sonar = "kind = \"sonar\"\ncone_deg = 30\n";
    EXPECT_EQ(sensorRefusal(sonar + "ring = { count = 4, radius_m = 0.1 }\n"), "");
    EXPECT_THAT(sensorRefusal(sonar), HasSubstr("expected either `ring` or `elements`"));
    EXPECT_THAT(sensorRefusal(sonar + "ring = { count = 65, radius_m = 0.1 }\n"),
                HasSubstr("ring.count: expected a whole number from 1 to 64"));
    EXPECT_THAT(sensorRefusal(sonar + "ring = { count = 4, radius_m = 3 }\n"),
                HasSubstr("ring: has an element that is at 3.000, 0.000, outside"));
    EXPECT_THAT(sensorRefusal(sonar + "elements = [{ x_m = 0, y_m = 3 }]\n"), HasSubstr("is at 0.000, 3.000, outside"));
    EXPECT_THAT(sensorRefusal("kind = \"sonar\"\ncone_deg = 190\nring = { count = 4, radius_m = 0.1 }\n"),
                HasSubstr("cone_deg: is 190.0; expected"));
    EXPECT_THAT(sensorRefusal("kind = \"infrared\"\nring = { count = 4, radius_m = 0.1 }\nrange_m = 0.8\n"),
                HasSubstr("reference_m: is missing"));
    EXPECT_EQ(sensorRefusal("kind = \"bumpers\"\nring = { count = 6 }\n"), "");
    EXPECT_THAT(sensorRefusal("kind = \"bumpers\"\nring = { count = 0 }\n"),
                HasSubstr("ring.count: expected a whole number from 1 to 64"));
    EXPECT_THAT(sensorRefusal("kind = \"bumpers\"\nsegments = [{ start_deg = 10, end_deg = 10 }]\n"),
                HasSubstr("end_deg: expected more than start_deg"));
    EXPECT_THAT(sensorRefusal("kind = \"bumpers\"\nsegments = []\n"), HasSubstr("segments: has 0; expected 1 to 64"));
    EXPECT_EQ(sensorRefusal("kind = \"wheel_encoders\"\nticks_per_m = 1000\ntrack_m = 0.3\n"), "");
    EXPECT_THAT(sensorRefusal("kind = \"wheel_encoders\"\nticks_per_m = 0\ntrack_m = 0.3\n"),
                HasSubstr("ticks_per_m: is 0.0; expected 1.0 to"));
}

TEST(SensorFiles, WhatIsWrongWithALineCameraIsOneLine) {
    const std::string camera = "kind = \"line_camera\"\nrange_m = 9\n", width = "width = 320\n",
                      view = "view_deg = 48\n";
    const std::string whole = camera + width + view;
    EXPECT_EQ(sensorRefusal(whole), "");
    EXPECT_EQ(sensorRefusal(whole + "floor_m = 1.5\nedge_noise_px = 0.5\nmisclassification = 0.01\nlatency_s = 0.1\n"
                                    "blobs = [\"ball\", \"blue_goal\"]\nleast_blob_px = 3\n"),
              "");
    EXPECT_EQ(sensorRefusal(camera + width + "lens = \"equiangular\"\nview_deg = 360\n"), "");
    for (const auto& [keys, expected] : std::map<std::string, std::string>{
             {camera + view, "sensor[\"s\"].width: is missing"},
             {camera + width, "sensor[\"s\"].view_deg: is missing"},
             {"kind = \"line_camera\"\n" + width + view, "sensor[\"s\"].range_m: is missing"},
             {camera + view + "width = 0\n", "sensor[\"s\"].width: expected a whole number from 1 to 4096"},
             {camera + width + "view_deg = 180\n", "sensor[\"s\"].view_deg: is 180.0; expected 0.1 to 170.0"},
             {camera + width + "lens = \"equiangular\"\nview_deg = 361\n",
              "sensor[\"s\"].view_deg: is 361.0; expected 0.1 to 360.0"},
             {whole + "lens = \"fisheye\"\n",
              "sensor[\"s\"].lens: is \"fisheye\"; expected one of \"pinhole\", \"equiangular\""},
             {whole + "floor_m = 9.5\n", "sensor[\"s\"].floor_m: is 9.5; expected 0.01 to 9.0"},
             {whole + "edge_noise_px = -1\n", "sensor[\"s\"].edge_noise_px: is -1.0; expected 0.0 to 10.0"},
             {whole + "misclassification = 2\n", "sensor[\"s\"].misclassification: is 2.0; expected 0.0 to 1.0"},
             {whole + "blobs = [\"ball\", \"nothing\"]\n",
              "sensor[\"s\"].blobs[2]: is \"nothing\"; expected one of \"floor\", \"marking\""},
             {whole + "blobs = [\"ball\", \"ball\"]\n", "sensor[\"s\"].blobs[2]: is there twice: \"ball\""},
             {whole + "least_blob_px = 0\n", "sensor[\"s\"].least_blob_px: expected a whole number from 1 to 4096"},
             {whole + "latency_s = 2\n", "sensor[\"s\"].latency_s: is 2.0; expected 0.0 to 1.0"},
             {whole + "position_m = [3.0, 0.0]\n", "sensor[\"s\"].position_m: is at 3.000, 0.000, outside"},
             {whole + "beams = 3\n", "sensor[\"s\"].beams: is not a known key"}}) {
        EXPECT_THAT(sensorRefusal(keys), HasSubstr(expected));
        EXPECT_THAT(sensorRefusal(keys), testing::MatchesRegex("r.toml:[0-9]+:[0-9]+: [^\n]*"));
    }
}

TEST(SensorPreset, ThoseThatShipAreSoundAndFitTheirRobots) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / "resources" / "sensors")) {
        const std::string name = entry.path().filename().string();
        const std::string robot = name.starts_with("pioneer") ? "pioneer1" : "b21";
        DiskDescriptions source({sourceFolder(), {}, ""});
        const auto textOf = [&](const std::filesystem::path& file) { return source.text(file.string())->value(); };
        std::map<std::string, std::string> texts = smallWorld();
        texts["preset.toml"] = textOf(entry.path());
        texts["shape.toml"] = textOf(sourceFolder() / "shapes" / (robot + ".toml"));
        texts["r.toml"] =
            "format = \"mrose robot\"\nversion = 1\nname = \"r\"\nshape = \"shape.toml\"\nmass_kg = 10\n"
            "control_period_s = 0.1\n[kinematics]\n[[sensor]]\nname = \"s\"\npreset = \"preset.toml\"\n";
        const auto loaded = loadFrom(texts);
        EXPECT_TRUE(loaded) << name << ": " << loaded.error().message();
        ++count;
    }
    EXPECT_EQ(count, 7u);
}

}  // namespace
}  // namespace mrose
