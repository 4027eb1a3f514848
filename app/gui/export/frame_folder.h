#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "export/frame_sink.h"
#include "io/made_folder.h"

namespace mrose::gui {

/// Error unless frames can become this folder: it is there already and not empty, or something else.
Expected<void> checkFrameFolder(const std::filesystem::path& folder);

/// A folder of numbered pictures, frame_0000.png and so on, with the folders above it. It appears when it is whole.
class FrameFolder final : public FrameSink {
public:
    /// For so many frames. Error: as checkFrameFolder(), or what the system says.
    static Expected<std::unique_ptr<FrameSink>> begin(const std::filesystem::path& folder, std::size_t frames);
    ~FrameFolder() override;

    Expected<void> add(const QImage& frame) override;
    Expected<bool> finish() override;

private:
    FrameFolder(std::filesystem::path folder, MadeFolder parent, std::size_t digits)
        : folder_(std::move(folder)), parent_(std::move(parent)), digits_(digits) {}

    std::filesystem::path folder_, part_;
    MadeFolder parent_;
    std::size_t digits_, next_ = 0;
};

}  // namespace mrose::gui
