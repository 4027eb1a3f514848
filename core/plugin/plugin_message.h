#pragma once

#include <cstdint>

namespace mrose {

/// Messages between a program and a plug-in's process. Each message begins with its kind; what follows is as messages/
/// writes it.
enum class PluginMessage : std::uint8_t {
    load,       ///< path, options
    loaded,     ///< attention, memory at the start
    refused,    ///< key, cause
    commands,   ///< period
    count,      ///< commands per period
    decide,     ///< observation, memory
    decided,    ///< decision, memory
    explain,    ///< memory
    explained,  ///< entries
};

}  // namespace mrose
