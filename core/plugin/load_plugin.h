#pragma once

#include <memory>
#include <string>
#include <vector>

#include "control/controller.h"
#include "io/error.h"

namespace mrose {

/// What stands before a plug-in's own memory in the world's state, the same whether it runs in the program or in a
/// process of its own.
struct PluginMemory {
    std::uint64_t ended = 0;  ///< not 0: its process ended; the robot stands from then on
    std::uint64_t unused = 0;
};

/// A controller out of a shared library. What it throws becomes a fault that names the library, as do commands that are
/// not finite or absurd. It may be asked from several threads at once, and asks the plug-in so.
class PluginController final : public Controller {
public:
    ~PluginController() override;

    const std::string& path() const { return path_; }
    std::size_t memorySize() const override { return sizeof(PluginMemory) + startMemory_.size(); }
    void start(std::span<std::byte> memory) const override;
    std::size_t commandsPerPeriod(Nanoseconds period) const override;
    Attention attention() const override { return attention_; }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    friend Expected<std::shared_ptr<const PluginController>> loadPlugin(const std::string&, const std::string&);
    struct Library;
    explicit PluginController(std::string path);
    Expected<void> open(const std::string& options);

    std::string path_;
    std::unique_ptr<Library> library_;
    std::vector<std::byte> startMemory_;  ///< of the plug-in itself
    Attention attention_;                 ///< likewise
};

/// Where the options of a plug-in hold its mappings: a table of the texts of network files.
constexpr const char* mappingsKey = "mappings";
/// Likewise the environment's landmarks: tables { name, x_m, y_m }.
constexpr const char* landmarksKey = "landmarks";

/// Loads the plug-in at `path` and makes one controller of it, with the TOML text `options`. Error: file `path` and
/// what is wrong: there is none, it is no plug-in, it was built for another interface or standard library, or its
/// controller's construction threw. Where it is an option, the error's key is the option's name.
Expected<std::shared_ptr<const PluginController>> loadPlugin(const std::string& path, const std::string& options);

}  // namespace mrose
