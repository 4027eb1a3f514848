#include "workflow/evaluate_localiser.h"

#include <algorithm>

#include "identification/sensor_samples.h"
#include "identification/sensor_summary.h"
#include "identification/sound_errors.h"
#include "io/format.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"

namespace mrose {
namespace {

Expected<SensorSamples> samplesFor(const SensorNetwork& network, const Log& log,
                                   const std::vector<std::string>& robots) {
    const SensorSamples samples = sensorSamples({&log, 1}, {.sensor = network.sensor,
                                                            .measures = SensorNetwork::Measures::pose,
                                                            .robots = robots,
                                                            .latency = network.latency,
                                                            .period = network.period});
    if (samples.readings() > 0) return samples;
    return fail(log.source, "has no pose that \"" + network.sensor + "\" reported and that there is ground truth for");
}

std::vector<LocaliserCase> casesOf(const SensorSamples& samples) {
    const SoundErrors sound = soundErrors(samples, LocaliserScores::dimensions);
    std::vector<LocaliserCase> cases;
    for (const SampledLook& look : samples.looks)
        for (std::size_t i = look.first; i < look.first + look.count; ++i) {
            const SensorCase& one = samples.cases[i];
            cases.push_back({one.state, samples.robots[static_cast<std::size_t>(look.robot)], look.time, one.reported,
                             one.reported && sound.holds(one.error), one.error});
        }
    return cases;
}

/// What must be known of the poses before a localisation is blamed for them.
std::vector<std::string> noticesOf(const std::vector<LocaliserCase>& cases, const Log& log,
                                   const SensorSummary& found) {
    std::vector<std::string> notices;
    const auto count = [&](auto which) { return static_cast<std::size_t>(std::ranges::count_if(cases, which)); };
    const std::size_t reported = count(&LocaliserCase::reported), sound = count(&LocaliserCase::sound);
    if (20 * (reported - sound) > reported)
        notices.push_back(std::to_string(reported - sound) + " of " + counted(reported, "pose") +
                          " are ten times farther off than most, and their errors are left out.");
    for (const InspectedSensor& sensor : found.each) {
        const std::string& robot = log.robots[sensor.robot].robot;
        if (sensor.found.pose.looksExchanged())
            notices.push_back("Robot " + robot + ": " + exchangedText(sensor.found.pose));
        else if (sensor.found.followed)
            notices.push_back("The poses of robot " + robot + " show " +
                              fixed(std::max(0.0, 100 * *sensor.found.followed), 0) +
                              " % of how it truly moved: are their stamps from another clock?");
    }
    return notices;
}

}  // namespace

Expected<LocaliserEvaluation> evaluateLocaliser(const EvaluateSensorRequest& request, const Progress& learns) {
    auto own = openSensor(request.network, SensorNetwork::Measures::pose);
    if (!own) return tl::unexpected(own.error());
    const auto log = openLog(request.log, request.robots);
    if (!log) return tl::unexpected(log.error());
    const auto samples = samplesFor(*own, *log, request.robots);
    if (!samples) return tl::unexpected(samples.error());
    const auto networks = openSensors(*own, request, learns);
    if (!networks) return tl::unexpected(networks.error());
    LocaliserEvaluation evaluation;
    evaluation.log = log->source;
    evaluation.synthetic = log->synthetic;
    evaluation.cases = casesOf(*samples);
    for (const NamedSensorNetwork& network : *networks) {
        // Each by its own latency.
        const auto asked = samplesFor(network.network, *log, request.robots);
        if (!asked) return tl::unexpected(asked.error());
        evaluation.scores.push_back(scoreLocaliser(network.name, LearnedSensorModel(network.network), casesOf(*asked)));
    }
    using Noise = IdealSensorModel::Noise;
    for (const auto& [name, noise] : {std::pair{"ideal plus noise", Noise::constant}, std::pair{"ideal", Noise::none}})
        evaluation.scores.push_back(scoreLocaliser(name, IdealSensorModel(*own, noise), evaluation.cases));
    evaluation.context = sensorContext(*own, request);
    std::vector<std::string>& notices = evaluation.context.notices;
    notices = noticesOf(*log);
    for (std::string& notice : noticesOf(*own, *log, samples->robots)) notices.push_back(std::move(notice));
    for (std::string& notice : besideNotices(*networks, request, *log)) notices.push_back(std::move(notice));
    for (std::string& notice :
         noticesOf(evaluation.cases, *log, summariseSensor({&*log, 1}, own->sensor, request.robots)))
        notices.push_back(std::move(notice));
    evaluation.network = std::move(*own);
    return evaluation;
}

}  // namespace mrose
