#pragma once

#include <cstdint>
#include <string>

#include "control/controller.h"
#include "io/bytes.h"

namespace mrose {

// What a program and a plug-in's process tell each other. Each message begins with its kind; numbers are as in
// io/bytes.h, runs of elements have their number in front.

enum class PluginMessage : std::uint8_t {
    load,      ///< path, options
    loaded,    ///< attention, memory at the start
    refused,   ///< key, cause
    commands,  ///< period
    count,     ///< commands per period
    decide,    ///< observation, memory
    decided,   ///< decision, memory
};

void appendText(std::string_view text, std::string& bytes);
void appendAttention(const Attention& attention, std::string& bytes);
void appendObservation(const Observation& observation, std::string& bytes);
void appendDecision(const Decision& decision, std::string& bytes);

// Whether there was a sound one; nothing is allocated for more elements than there are bytes for.
bool readText(ByteReader& reader, std::string& text);
bool readAttention(ByteReader& reader, Attention& attention);
bool readObservation(ByteReader& reader, Observation& observation);
bool readDecision(ByteReader& reader, Decision& decision);

}  // namespace mrose
