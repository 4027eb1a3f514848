#include "workflow/outputs.h"

#include <filesystem>

#include "io/file.h"

namespace mrose {

Expected<void> checkNotRead(const std::string& output, const std::vector<std::string>& inputs) {
    for (const std::string& input : inputs) {
        std::error_code unknown;
        if (std::filesystem::equivalent(output, input, unknown))
            return fail(output, "is read by this command; expected another file for what it writes");
    }
    return {};
}

Expected<void> checkOutput(const std::string& output, const std::vector<std::string>& inputs, bool overwrite) {
    if (auto other = checkNotRead(output, inputs); !other) return other;
    return checkWritable(output, overwrite);
}

}  // namespace mrose
