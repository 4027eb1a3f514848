#pragma once

#include <string>

#include "io/error.h"

namespace mrose {

/// What a file holds, by its content.
enum class FileKind { scenario, recording, network, results, log };

/// Reads no more than a file's beginning, and never waits for a pipe. Error: what it is instead, and what is expected.
Expected<FileKind> fileKind(const std::string& path);

}  // namespace mrose
