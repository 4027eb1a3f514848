#include "sensing/sensor_kinds.h"

#include <algorithm>
#include <set>

#include "sensing/body_sight.h"
#include "sensing/bumpers.h"
#include "sensing/infrared_ring.h"
#include "sensing/laser.h"
#include "sensing/line_camera.h"
#include "sensing/odometry.h"
#include "sensing/self_localisation.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_view.h"
#include "sensing/sonar_ring.h"
#include "sensing/wheel_encoders.h"

namespace mrose {
namespace {

/// Of the reference model, which has errors of its own.
SelfLocalisation readReferenceSelf(TomlTable& table) {
    SelfLocalisation self;
    self.latency = durationOr(table, "latency_s", 100'000'000, latencies);
    return self;
}

}  // namespace

Perception readPerception(TomlTable table) {
    Perception perception;
    if (table.has("model") && table.choice("model", {"noise", "reference"}) == 1)
        perception.model = Perception::Model::reference;
    const bool reference = perception.model == Perception::Model::reference;
    if (reference) perception.errorScale = table.numberOr("error_scale", perception.errorScale, {0, 10});
    const auto read = [&](const char* key, auto reader) {
        TomlTable part = table.tableOrEmpty(key);
        auto options = reader(part);
        part.rejectUnknown();
        return options;
    };
    perception.self = read("self", reference ? readReferenceSelf : readSelfLocalisation);
    perception.objects = read("objects", reference ? readSightField : readBodySight);
    perception.robots = read("robots", reference ? readSightField : readBodySight);
    perception.velocityNoise = table.numberOr("velocity_noise_mps", 0, metresOff);
    perception.rotationNoise = angleOr(table, "rotation_noise_degps", 0, degreesOff);
    table.rejectUnknown();
    return perception;
}

std::vector<SensorPointer> standardSensors(const Perception& perception) {
    return {std::make_shared<const SelfLocaliser>(perception.self),
            std::make_shared<const BodySensor>(perception.robots, perception.objects, perception.self.biasTime),
            std::make_shared<const Odometry>(perception.velocityNoise, perception.rotationNoise)};
}

namespace {

SensorPointer readCamera(TomlTable& table, const SensorTraits& traits, const SensorSources& /*sources*/) {
    const double biasTime = table.numberOr("bias_time_s", SelfLocalisation().biasTime, {0.001, 1e6});
    const BodySight sight = readBodySight(table);
    return std::make_shared<const BodySensor>(sight, sight, biasTime, traits);
}

SensorPointer readLocaliser(TomlTable& table, const SensorTraits& traits, const SensorSources& /*sources*/) {
    return std::make_shared<const SelfLocaliser>(readSelfLocalisation(table), traits);
}

SensorPointer readOdometry(TomlTable& table, const SensorTraits& traits, const SensorSources& /*sources*/) {
    if (traits.period > 0) table.reject("period_s", "odometry measures at each control instant; expected none");
    const double velocityNoise = table.numberOr("velocity_noise_mps", 0, metresOff);
    return std::make_shared<const Odometry>(velocityNoise, angleOr(table, "rotation_noise_degps", 0, degreesOff),
                                            traits);
}

constexpr SensorKind kinds[] = {{"camera", readCamera},
                                {"localisation", readLocaliser},
                                {"odometry", readOdometry},
                                {"learned", readLearnedSensor},
                                {"laser", readLaser},
                                {"sonar", readSonarRing},
                                {"infrared", readInfraredRing},
                                {"bumpers", readBumpers},
                                {"wheel_encoders", readWheelEncoders},
                                {"line_camera", readLineCamera}};

/// What every robot's sensors are called, and what a controller and a motion model have of their own.
constexpr ReadingName takenNames[] = {selfReading,     odometryReading, robotsReading, objectsReading,
                                      messagesReading, "sight",         "controller",  "motion"};

}  // namespace

std::span<const SensorKind> sensorKinds() { return kinds; }

SensorPointer readSensor(TomlTable& table, const SensorTraits& traits, const SensorSources& sources,
                         std::span<const SensorKind> of) {
    std::vector<std::string_view> words;
    for (const SensorKind& kind : of) words.push_back(kind.name);
    const std::size_t kind = table.choice("kind", words);
    return table.failed() ? nullptr : of[kind].read(table, traits, sources);
}

std::vector<SensorPointer> readSensors(std::vector<TomlTable> tables, const SensorSources& sources,
                                       std::span<const SensorKind> of) {
    std::set<std::string, std::less<>> names(std::begin(takenNames), std::end(takenNames));
    std::vector<SensorPointer> sensors;
    const std::size_t most = SensorView::mostSensors - standardSensors({}).size();
    for (TomlTable& table : tables) {
        if (sensors.size() == most) {
            table.reject("name", "is of too many sensors; expected at most " + std::to_string(most));
            break;
        }
        if (table.has("preset")) {
            const Value* const preset = sources.preset(table, "preset");
            if (preset == nullptr) continue;
            const Value::File file = table.value("preset")->sharedFile();
            table.fallBackOn(*preset, file ? file->reference : table.string("preset"));
        }
        SensorTraits traits{name(table, "name"), durationOr(table, "period_s", 0, {0.001, 10})};
        const bool plain =
            std::ranges::all_of(traits.name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
        if (!plain || traits.name.size() > SensorTraits::mostName)
            table.reject("name", "expected letters, digits and _, at most " + std::to_string(SensorTraits::mostName));
        if (!names.insert(traits.name).second) table.reject("name", "is taken: \"" + traits.name + '"');
        if (table.failed()) continue;
        sensors.push_back(readSensor(table, traits, sources, of));
        table.rejectUnknown();
    }
    return sensors;
}

}  // namespace mrose
