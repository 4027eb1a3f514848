#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "control/controller.h"
#include "io/error.h"

namespace mrose {

class PluginProcess;

struct IsolationOptions {
    /// The program and the arguments that serve a plug-in (plugin_host.h); the number of its socket is added.
    std::vector<std::string> words;
    double limit = 1;          ///< s, for each decision
    double loadingLimit = 10;  ///< s
};

/// A plug-in's controller in a process of its own. Observation and memory go there, decision and memory come back, so
/// that rewinding is as exact as in the program, and the world's state is the same. When the process ends or takes too
/// long, that is a fault, and the robot stands from then on: the state remembers. Going back to a state before starts
/// the process anew; what it failed at is not asked again. May be asked from several threads; they take turns.
class IsolatedController final : public Controller {
public:
    ~IsolatedController() override;

    const std::string& path() const { return path_; }
    std::size_t memorySize() const override { return startMemory_.size(); }
    void start(std::span<std::byte> memory) const override;
    std::size_t commandsPerPeriod(Nanoseconds period) const override;
    Attention attention() const override { return attention_; }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    friend Expected<std::shared_ptr<const IsolatedController>> isolatePlugin(const std::string&, const std::string&,
                                                                             const IsolationOptions&);
    using Failure = std::string;
    IsolatedController(std::string path, std::string options, IsolationOptions isolation);
    struct Opened {
        Attention attention;
        std::string memory;  ///< at a start
    };
    Expected<Opened> open() const;
    tl::expected<std::string, Failure> ask(const std::string& message) const;
    tl::expected<void, Failure> askDecision(const Observation& observation, std::span<std::byte> memory,
                                            Decision& decision) const;
    tl::expected<std::vector<MemoryEntry>, Failure> askExplanation(std::span<const std::byte> memory) const;
    /// The answer, or what is known of the same question.
    tl::expected<std::string, Failure> askOnce(const std::string& message) const;
    Failure failedAt(std::string message, Failure failure) const;

    std::string path_, options_;
    IsolationOptions isolation_;
    std::string startMemory_;
    Attention attention_;
    mutable std::mutex turn_;
    mutable std::unique_ptr<PluginProcess> process_;  ///< no part of what is decided
    struct Failed {
        std::string message;
        Failure failure;
    };
    mutable std::deque<Failed> failed_;  ///< the latest; nor is this
};

/// Loads a plug-in as loadPlugin() does, but in a process of its own. Error: as there, and that the process could not
/// be started, ended or took too long.
Expected<std::shared_ptr<const IsolatedController>> isolatePlugin(const std::string& path, const std::string& options,
                                                                  const IsolationOptions& isolation);

}  // namespace mrose
