#include "workflow/outputs.h"

#include <filesystem>

#include "io/file.h"

namespace mrose {

Expected<void> checkNotRead(const std::string& output, const std::vector<std::string>& inputs) {
    for (const std::string& input : inputs) {
        std::error_code unknown;
        if (std::filesystem::equivalent(output, input, unknown))
            return fail(output, "is read by this command; expected another file for what it writes");
        const std::filesystem::path folder = std::filesystem::absolute(output, unknown).parent_path();
        if (std::filesystem::exists(output, unknown) && std::filesystem::is_directory(input, unknown) &&
            std::filesystem::equivalent(folder, input, unknown))
            return fail(output,
                        "lies in a folder that is read by this command; expected another place for what it writes");
    }
    return {};
}

Expected<void> checkOutput(const std::string& output, const std::vector<std::string>& inputs, bool overwrite) {
    if (auto other = checkNotRead(output, inputs); !other) return other;
    return checkWritable(output, overwrite);
}

}  // namespace mrose
