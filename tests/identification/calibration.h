#pragma once

#include <array>
#include <cmath>

#include "identification/sensor_samples.h"
#include "perception/learned_sensor.h"
#include "synthetic/log_generator.h"

namespace mrose {

/// The reference robot for so many minutes, with what its sensors report.
inline std::vector<Log> referenceLogs(int minutes, std::uint64_t seed) {
    SyntheticPart part{DrivePattern::random, minutes, 60};
    part.sensors = true;
    std::vector<Log> logs;
    logs.push_back(generateLog(part, seed).value());
    return logs;
}

/// The normal distribution, with the same gross errors, that is best where nothing depends on the state.
inline ReadingDistribution constantNoise(const SensorSamples& samples, const SensorNetwork& network) {
    ReadingDistribution constant;
    constant.form.dimensions = network.form.dimensions;
    constant.gross = network.gross;
    for (std::size_t d = 0; d < static_cast<std::size_t>(network.form.dimensions); ++d) {
        double sum = 0, squares = 0, count = 0;
        for (const SensorCase& one : samples.cases)
            if (one.reported && std::hypot(one.error[0], one.error[1]) < 0.4)
                sum += one.error[d], squares += one.error[d] * one.error[d], ++count;
        constant.component[0].mean[d] = sum / count;
        constant.component[0].spread[d] = std::sqrt(squares / count - sum / count * sum / count);
    }
    return constant;
}

/// How a learned sensor fits what it did not learn from.
struct Calibration {
    double cases = 0, readings = 0, expected = 0;                        ///< expected: readings by their probabilities
    std::array<double, ReadingForm::maxDimensions> half{}, nearlyAll{};  ///< shares within the central 50 % and 90 %
    double likelihood = 0, ofConstant = 0;  ///< mean logarithms, of the errors within reach of the gross ones

    Calibration(const LearnedSensor& sensor, const SensorSamples& unseen, const ReadingDistribution& constant) {
        const std::size_t dimensions = static_cast<std::size_t>(sensor.network().form.dimensions);
        double within = 0;
        for (const SensorCase& one : unseen.cases) {
            ReadingDistribution learned;
            sensor.distributions({&one.state, 1}, 0, {&learned, 1});
            ++cases;
            expected += learned.probability();
            if (!one.reported) continue;
            ++readings;
            bool inReach = true;
            for (std::size_t d = 0; d < dimensions; ++d) {
                const double off = std::abs(learned.probabilityBelow(static_cast<int>(d), one.error[d]) - 0.5);
                half[d] += off < 0.25;
                nearlyAll[d] += off < 0.45;
                inReach = inReach && std::abs(one.error[d]) <= learned.gross.reach[d];
            }
            if (!inReach) continue;
            ++within;
            likelihood += std::log(learned.density(one.error));
            ofConstant += std::log(constant.density(one.error));
        }
        likelihood /= within;
        ofConstant /= within;
        for (std::size_t d = 0; d < dimensions; ++d) half[d] /= readings, nearlyAll[d] /= readings;
    }
};

}  // namespace mrose
