#pragma once

#include <cstdint>
#include <string>

namespace mrose::format {

// Names in a recording's file; README.md of this folder says what lies behind them.

constexpr const char* run = "mrose.run";                  ///< metadata
constexpr const char* shown = "mrose.shown";              ///< metadata
constexpr const char* controllers = "mrose.controllers";  ///< metadata
constexpr const char* version = "2";
constexpr const char* textsVersion = "1";                  ///< scenarios were kept as the texts of their descriptions
constexpr const char* descriptionPrefix = "description/";  ///< attachments
constexpr const char* branchPrefix = "mrose/branch/";      ///< attachments: branch
constexpr const char* scenarioPrefix = "mrose/scenario/";  ///< attachments: branch
constexpr const char* blockPrefix = "mrose/block/";        ///< attachments: branch/tick
constexpr const char* blockType = "application/zstd";

// Keys of `run`.
constexpr const char* formatKey = "format";
constexpr const char* versionKey = "mrose_version";
constexpr const char* commitKey = "commit";
constexpr const char* compilerKey = "compiler";
constexpr const char* buildTypeKey = "build_type";
constexpr const char* stepKey = "step";
constexpr const char* scenarioKey = "scenario";
constexpr const char* scenarioFileKey = "scenario_file";
constexpr const char* seedKey = "seed";
constexpr const char* tickLengthKey = "tick_length_ns";
constexpr const char* commandLineKey = "command_line";

// Keys of `shown`.
constexpr const char* branchKey = "branch";
constexpr const char* tickKey = "tick";

}  // namespace mrose::format
