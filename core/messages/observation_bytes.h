#pragma once

#include <deque>
#include <string>

#include "control/controller.h"
#include "io/bytes.h"

namespace mrose {

// Observations as plug-ins' processes get them. README.md tells the layout: each reading says what its records are made
// of, so that whoever reads them need not know the sensor.

/// Types of records that were read from messages. It must live as long as observations that were read with it.
class RecordTypes {
public:
    /// One that is equal to `type`.
    const RecordType& of(RecordType type);

private:
    std::deque<RecordType> types_;
};

void appendObservation(const Observation& observation, std::string& bytes);
/// Whether there was a sound one; nothing is allocated for more elements than there are bytes for.
bool readObservation(ByteReader& reader, RecordTypes& types, Observation& observation);

void appendAttention(const Attention& attention, std::string& bytes);
bool readAttention(ByteReader& reader, Attention& attention);

}  // namespace mrose
