#pragma once

#include <memory>
#include <string>

#include "control/controller.h"
#include "io/error.h"

// Stands in for core/plugin until it is merged.
namespace mrose {

inline Expected<std::shared_ptr<const Controller>> loadPlugin(const std::string& path, const std::string&) {
    return fail(path, "plug-ins are not here yet");
}

}  // namespace mrose
