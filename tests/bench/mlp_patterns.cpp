#include "bench/mlp_patterns.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>

#include "world/noise.h"

namespace mrose::bench {

namespace {

constexpr int kInputs = 4, kOutputs = 5, kWidth = kInputs + kOutputs;
using Row = std::array<double, kWidth>;

/// A robot whose wheels follow their commands late, with a lag and within limits.
class SyntheticRobot {
public:
    explicit SyntheticRobot(std::uint32_t index) : index_(index) {}

    /// One control period of 100 ms.
    Row period(std::int64_t tick) {
        tick_ = tick;
        channel_ = 0;
        chooseCommand();
        const double v = speed(), w = turnRate();
        double x = 0, y = 0, heading = 0;
        for (int step = 0; step < kSteps; ++step) {
            const bool late = step < kDeadSteps;
            follow(late ? lastForward_ : forward_, late ? lastTurn_ : turn_);
            const double rate = turnRate() * (1 - 0.15 * std::min(1.0, std::abs(speed() * turnRate())));
            x += speed() * std::cos(heading + rate * kStep / 2) * kStep;
            y += speed() * std::sin(heading + rate * kStep / 2) * kStep;
            heading += rate * kStep;
        }
        lastForward_ = forward_;
        lastTurn_ = turn_;
        return {v + normal(0.0037),
                w + normal(0.0125),
                forward_,
                turn_,
                x + normal(0.0006),
                y + normal(0.00025),
                heading + normal(0.0019),
                speed() + normal(0.0037),
                turnRate() + normal(0.0125)};
    }

private:
    static constexpr int kSteps = 25, kDeadSteps = 10;
    static constexpr double kStep = 0.1 / kSteps, kTrack = 0.36, kLag = 0.13;

    double uniform() { return uniformNoise({11, tick_, index_, channel_++}); }
    double normal(double deviation) { return deviation * normalNoise({12, tick_, index_, channel_++}); }
    double speed() const { return (left_ + right_) / 2; }
    double turnRate() const { return (right_ - left_) / kTrack; }

    void chooseCommand() {
        if (hold_-- > 0) return;
        hold_ = static_cast<int>(1 + 14 * uniform());
        forward_ = 2 * uniform() - 0.7;
        turn_ = 2.6 * (uniform() + uniform() - 1);
        const double kind = uniform();  // of manoeuvre: on the spot, straight, halt, or both
        if (kind < 0.12) forward_ = 0;
        if (kind > 0.7) turn_ = 0;
        if (kind > 0.92) forward_ = 0;
    }

    void follow(double forward, double turn) {
        approach(left_, forward - turn * kTrack / 2, 1.0);
        approach(right_, forward + turn * kTrack / 2, 0.97);
    }

    static void approach(double& wheel, double wanted, double gain) {
        wanted = gain * std::clamp(wanted, -1.0, 1.0);
        if (std::abs(wanted) < 0.03) wanted = 0;
        const bool braking = wheel * (wanted - wheel) < 0;
        const double limit = braking ? 2.5 : 1.7;
        wheel += std::clamp((wanted - wheel) / kLag, -limit, limit) * kStep;
    }

    std::uint32_t index_, channel_ = 0;
    std::int64_t tick_ = 0;
    int hold_ = 0;
    double left_ = 0, right_ = 0, forward_ = 0, turn_ = 0, lastForward_ = 0, lastTurn_ = 0;
};

/// The rows are by periods of many robots; the first periods, from rest, are left out.
std::vector<Row> drive(int robots, int periods, int rest) {
    std::vector<Row> rows;
    std::vector<SyntheticRobot> all;
    for (int robot = 0; robot < robots; ++robot) all.emplace_back(robot);
    for (int period = 0; period < periods; ++period)
        for (SyntheticRobot& robot : all) {
            const Row row = robot.period(period);
            if (period >= rest) rows.push_back(row);
        }
    return rows;
}

std::vector<float> standardised(const std::vector<Row>& rows, int training) {
    Row mean{}, square{};
    for (int i = 0; i < training; ++i)
        for (int c = 0; c < kWidth; ++c) {
            mean[c] += rows[i][c] / training;
            square[c] += rows[i][c] * rows[i][c] / training;
        }
    std::vector<float> values;
    for (const Row& row : rows)
        for (int c = 0; c < kWidth; ++c)
            values.push_back(static_cast<float>((row[c] - mean[c]) / std::sqrt(square[c] - mean[c] * mean[c])));
    return values;
}

}  // namespace

PatternSet PatternRows::set(int first, int count) const {
    const std::size_t patterns = static_cast<std::size_t>(count);
    PatternSet result{{patterns, inputs}, {patterns, outputs}};
    const float* from = values.data() + static_cast<std::size_t>(first) * (inputs + outputs);
    for (std::size_t p = 0; p < patterns; ++p) {
        for (int i = 0; i < inputs; ++i) result.inputs(p, i) = *from++;
        for (int k = 0; k < outputs; ++k) result.targets(p, k) = *from++;
    }
    return result;
}

Expected<PatternRows> readPatterns(const std::filesystem::path& file) {
    static_assert(std::endian::native == std::endian::little);
    std::ifstream stream(file, std::ios::binary);
    std::int32_t head[4] = {};
    if (!stream.read(reinterpret_cast<char*>(head), sizeof head)) return fail(file.string(), "cannot be read");
    for (const std::int32_t count : head)
        if (count < 1 || count > 10'000'000) return fail(file.string(), "is not a file of patterns");
    PatternRows rows{head[0], head[1], head[2], head[3], {}};
    rows.values.resize((static_cast<std::size_t>(head[0]) + head[1]) * (head[2] + head[3]));
    if (!stream.read(reinterpret_cast<char*>(rows.values.data()),
                     static_cast<std::streamsize>(rows.values.size() * sizeof(float))))
        return fail(file.string(), "ends before its last pattern");
    return rows;
}

PatternRows syntheticPatterns() {
    constexpr int kTraining = 100'000, kValidation = 20'000, kRobots = 2000, kRest = 10;
    const std::vector<Row> rows = drive(kRobots, (kTraining + kValidation) / kRobots + kRest, kRest);
    return {kTraining, kValidation, kInputs, kOutputs, standardised(rows, kTraining)};
}

}  // namespace mrose::bench
