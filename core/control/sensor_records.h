#pragma once

#include <cstddef>
#include <cstdint>

#include "control/reading.h"
#include "world/colour_class.h"

namespace mrose {

// What the sensors that measure surroundings report: a record for each of their elements (Sensor::elements), in their
// order. Directions are counter-clockwise from the robot's heading.

/// A laser's beam or a sonar's transducer: how far it is to what it met.
struct RangeEcho {
    double bearing = 0;  ///< rad
    double range = 0;    ///< m, from the element; infinite: no echo
    bool operator==(const RangeEcho&) const = default;
};

/// An infrared element: how much of its light comes back.
struct InfraredEcho {
    double bearing = 0;    ///< rad
    double intensity = 0;  ///< 0 ... 1
    bool operator==(const InfraredEcho&) const = default;
};

/// A bumper's segment.
struct BumperContact {
    double bearing = 0;         ///< rad, of its middle
    std::uint32_t pressed = 0;  ///< 1: something touched it since the measurement before
    std::uint32_t touches = 0;  ///< that have begun since the run's start
    bool operator==(const BumperContact&) const = default;
};

/// Wheel encoders: counts since the run's start, forward positive.
struct WheelTicks {
    std::int64_t left = 0, right = 0;
    bool operator==(const WheelTicks&) const = default;
};

/// A pixel of a line camera.
struct ColourPixel {
    double bearing = 0;  ///< rad, of its middle
    ColourClass colourClass = ColourClass::nothing;
    std::uint32_t unused = 0;
    bool operator==(const ColourPixel&) const = default;
};

/// Neighbouring pixels of one class, as many as there are.
struct ColourBlob {
    double bearing = 0;  ///< rad, of its middle: its edges are half its width to the left and to the right
    double width = 0;    ///< rad
    ColourClass colourClass = ColourClass::nothing;
    std::uint32_t pixels = 0;
    bool operator==(const ColourBlob&) const = default;
};

inline const RecordType rangeEchoRecord{"range_echo",
                                        sizeof(RangeEcho),
                                        {field<double>("bearing", "rad", offsetof(RangeEcho, bearing)),
                                         field<double>("range", "m", offsetof(RangeEcho, range))}};
template <>
inline const RecordType& recordType<RangeEcho>() {
    return rangeEchoRecord;
}

inline const RecordType infraredEchoRecord{"infrared_echo",
                                           sizeof(InfraredEcho),
                                           {field<double>("bearing", "rad", offsetof(InfraredEcho, bearing)),
                                            field<double>("intensity", "", offsetof(InfraredEcho, intensity))}};
template <>
inline const RecordType& recordType<InfraredEcho>() {
    return infraredEchoRecord;
}

inline const RecordType bumperContactRecord{"bumper_contact",
                                            sizeof(BumperContact),
                                            {field<double>("bearing", "rad", offsetof(BumperContact, bearing)),
                                             field<std::uint32_t>("pressed", "", offsetof(BumperContact, pressed)),
                                             field<std::uint32_t>("touches", "", offsetof(BumperContact, touches))}};
template <>
inline const RecordType& recordType<BumperContact>() {
    return bumperContactRecord;
}

inline const RecordType wheelTicksRecord{"wheel_ticks",
                                         sizeof(WheelTicks),
                                         {field<std::int64_t>("left", "", offsetof(WheelTicks, left)),
                                          field<std::int64_t>("right", "", offsetof(WheelTicks, right))}};
template <>
inline const RecordType& recordType<WheelTicks>() {
    return wheelTicksRecord;
}

inline const RecordType colourPixelRecord{"colour_pixel",
                                          sizeof(ColourPixel),
                                          {field<double>("bearing", "rad", offsetof(ColourPixel, bearing)),
                                           field<std::uint32_t>("class", "", offsetof(ColourPixel, colourClass))}};
template <>
inline const RecordType& recordType<ColourPixel>() {
    return colourPixelRecord;
}

inline const RecordType colourBlobRecord{"colour_blob",
                                         sizeof(ColourBlob),
                                         {field<double>("bearing", "rad", offsetof(ColourBlob, bearing)),
                                          field<double>("width", "rad", offsetof(ColourBlob, width)),
                                          field<std::uint32_t>("class", "", offsetof(ColourBlob, colourClass)),
                                          field<std::uint32_t>("pixels", "", offsetof(ColourBlob, pixels))}};
template <>
inline const RecordType& recordType<ColourBlob>() {
    return colourBlobRecord;
}

}  // namespace mrose
