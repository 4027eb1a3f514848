#include "motion/driving_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;
using Driving = FamiliarDriving::Driving;

void addParts(Quantity quantity, const FamiliarDriving::Channel& channel, MotionNetwork& raw) {
    const double length = (channel.oldest - channel.newest) / double(DrivingReader::parts);
    for (std::size_t i = 0; i < DrivingReader::parts; ++i) {
        NetworkInput& part = raw.inputs.emplace_back();
        part.quantity = quantity;
        part.newest = channel.newest + double(i) * length;
        part.oldest = i + 1 == DrivingReader::parts ? channel.oldest : channel.newest + double(i + 1) * length;
    }
}

MotionNetwork rawNetwork(MotionNetwork::Form form, const FamiliarDriving& channels) {
    MotionNetwork raw;
    raw.form = form;
    addParts(Quantity::commandV, channels.v, raw);
    addParts(Quantity::commandW, channels.w, raw);
    for (const Quantity velocity : {Quantity::velocityV, Quantity::velocityW})
        raw.inputs.emplace_back().quantity = velocity;
    return raw;
}

/// The way from part to part beyond that from the first to the last.
double reversals(const double* parts) {
    double way = 0;
    for (std::size_t i = 0; i + 1 < DrivingReader::parts; ++i) way += std::abs(parts[i + 1] - parts[i]);
    return std::max(0.0, way - std::abs(parts[DrivingReader::parts - 1] - parts[0]));
}

double squaredDistance(const Driving& a, const Driving& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

}  // namespace

DrivingReader::DrivingReader(MotionNetwork::Form form, FamiliarDriving channels)
    : familiar_(std::move(channels)),
      velocities_(form == MotionNetwork::Form::state),
      raw_(rawNetwork(form, familiar_)),
      reader_(raw_) {}

Driving DrivingReader::driving(std::span<const double> rawInputs) const {
    const double *const v = rawInputs.data(), *const w = v + parts, *const velocity = w + parts;
    constexpr std::size_t half = parts / 2;
    const auto newer = [](const double* of) { return std::accumulate(of, of + half, 0.0) / double(half); };
    const auto older = [&](const double* of) { return newer(of + half); };
    const auto mean = [&](const double* of) { return (newer(of) + older(of)) / 2; };
    Driving driving{velocities_ ? velocity[0] : older(v), velocities_ ? velocity[1] : older(w),
                    velocities_ ? mean(v) : newer(v),     velocities_ ? mean(w) : newer(w),
                    reversalWeight * reversals(v),        reversalWeight * reversals(w)};
    for (std::size_t i = 0; i < driving.size(); ++i) driving[i] /= i % 2 == 0 ? familiar_.v.scale : familiar_.w.scale;
    return driving;
}

Driving DrivingReader::driving(const MotionInput& input) const {
    std::array<double, 2 * parts + 2> rawInputs;
    reader_.readRaw(input, -1, rawInputs.data());
    return driving(rawInputs);
}

double DrivingReader::distance(const Driving& driving) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Driving& prototype : familiar_.prototypes)
        nearest = std::min(nearest, squaredDistance(prototype, driving));
    return std::sqrt(nearest);
}

double DrivingReader::unfamiliar(const Driving& driving) const {
    const double d = distance(driving), last = familiar_.distances.back();
    const auto between = [&](double from, double to) { return to > from ? (d - from) / (to - from) : 1.0; };
    double from = 0, value = 0;
    for (const double to : familiar_.distances) {
        if (d <= to) return value + 0.3 * between(from, to);
        from = to;
        value += 0.3;
    }
    return FamiliarDriving::bound + (1 - FamiliarDriving::bound) * std::min(1.0, between(last, 1.5 * last));
}

bool DrivingReader::isUnfamiliar(const MotionInput& input) const {
    const Driving now = driving(input);
    const double bound = familiar_.distances.back() * familiar_.distances.back();
    return std::none_of(familiar_.prototypes.begin(), familiar_.prototypes.end(),
                        [&](const Driving& prototype) { return squaredDistance(prototype, now) <= bound; });
}

}  // namespace mrose
