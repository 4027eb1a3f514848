#pragma once

#include "sensing/sensor.h"

namespace mrose {

/// A sensor whose elements all measure what is around their robot at one instant.
class ElementSensor : public Sensor {
public:
    ElementSensor(SensorTraits traits, Nanoseconds latency) : traits_(std::move(traits)), latency_(latency) {}

    std::string name() const final { return traits_.name; }
    Nanoseconds period() const final { return traits_.period; }
    Nanoseconds latency() const final { return latency_; }
    bool exact() const final { return true; }

private:
    SensorTraits traits_;
    Nanoseconds latency_;
};

}  // namespace mrose
