#pragma once

#include <memory>
#include <span>
#include <string>

#include "perception/learned_sensor.h"

namespace mrose {

/// Who predicts what a sensor reports: a learned sensor, or one that is thought up.
class SensorModel {
public:
    virtual ~SensorModel() = default;

    virtual Nanoseconds latency() const = 0;  ///< from what is measured to the stamp
    virtual View view() const = 0;

    /// The distribution of the reading of each state; probability 0 of what it never reports. `robot`: whose sensor it
    /// is, by name.
    virtual void distributions(std::span<const SensedState> states, const std::string& robot,
                               std::span<ReadingDistribution> to) const = 0;

    /// What its readings have in common; nullptr where it does not say.
    virtual const ReadingNoises* noises() const { return nullptr; }
};

class LearnedSensorModel final : public SensorModel {
public:
    explicit LearnedSensorModel(SensorNetwork network) : sensor_(std::move(network)) {}

    const SensorNetwork& network() const { return sensor_.network(); }
    Nanoseconds latency() const override { return network().latency; }
    View view() const override { return network().view; }
    const ReadingNoises* noises() const override { return &network().noise; }
    void distributions(std::span<const SensedState> states, const std::string& robot,
                       std::span<ReadingDistribution> to) const override;

private:
    LearnedSensor sensor_;
};

/// Reports what is in view with nothing before it, or its robot's pose: always and exactly, or with the network's
/// constant noise.
class IdealSensorModel final : public SensorModel {
public:
    enum class Noise { none, constant };
    /// Latency, view and noise are those of `like`.
    IdealSensorModel(const SensorNetwork& like, Noise noise);

    Nanoseconds latency() const override { return latency_; }
    View view() const override { return view_; }
    void distributions(std::span<const SensedState> states, const std::string& robot,
                       std::span<ReadingDistribution> to) const override;

private:
    Nanoseconds latency_;
    View view_;
    bool pose_;
    ReadingDistribution seen_, unseen_;
};

}  // namespace mrose
