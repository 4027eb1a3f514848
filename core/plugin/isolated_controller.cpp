#include "plugin/isolated_controller.h"

#include <algorithm>
#include <cstring>

#include "messages/decision_bytes.h"
#include "messages/memory_entry_bytes.h"
#include "messages/observation_bytes.h"
#include "messages/text_bytes.h"
#include "plugin/load_plugin.h"
#include "plugin/plugin_message.h"
#include "plugin/plugin_process.h"
#include "world/command_history.h"

namespace mrose {
namespace {

std::string begin(PluginMessage kind) { return std::string(1, static_cast<char>(kind)); }

constexpr std::size_t mostFailed = 16;
constexpr const char* nonsense = "answered what cannot be read";

}  // namespace

IsolatedController::IsolatedController(std::string path, std::string options, IsolationOptions isolation)
    : path_(std::move(path)), options_(std::move(options)), isolation_(std::move(isolation)) {}
IsolatedController::~IsolatedController() = default;

/// Starts the process and loads the plug-in in it.
Expected<IsolatedController::Opened> IsolatedController::open() const {
    auto process = PluginProcess::start(isolation_.words);
    if (!process) return tl::unexpected(process.error());
    std::string message = begin(PluginMessage::load);
    appendText(path_, message);
    appendText(options_, message);
    const auto answer = (*process)->ask(message, isolation_.loadingLimit);
    if (!answer) return fail(path_, "its process " + answer.error() + " while it was loaded");
    ByteReader reader(*answer);
    const auto kind = static_cast<PluginMessage>(reader.number<std::uint8_t>());
    std::string key, cause;
    if (kind == PluginMessage::refused && readText(reader, key) && readText(reader, cause) && reader.done())
        return fail(path_, cause, 0, key);
    Opened opened;
    if (kind != PluginMessage::loaded || !readAttention(reader, opened.attention) ||
        reader.rest().size() < sizeof(PluginMemory))
        return fail(path_, std::string("its process ") + nonsense);
    process_ = std::move(*process);
    opened.memory = reader.rest();
    return opened;
}

tl::expected<std::string, std::string> IsolatedController::ask(const std::string& message) const {
    if (!process_) {
        const auto opened = open();
        if (!opened) return tl::unexpected(opened.error().cause);
        if (opened->memory.size() != startMemory_.size())
            return tl::unexpected(std::string("has another memory than before"));
    }
    auto answer = process_->ask(message, isolation_.limit);
    if (!answer) process_.reset();
    return answer;
}

void IsolatedController::start(std::span<std::byte> memory) const {
    std::memcpy(memory.data(), startMemory_.data(), startMemory_.size());
}

std::size_t IsolatedController::commandsPerPeriod(Nanoseconds period) const {
    const std::lock_guard lock(turn_);
    std::string message = begin(PluginMessage::commands);
    appendNumber(message, period);
    const auto answer = ask(message);
    if (!answer) return 1;
    ByteReader reader(*answer);
    const bool sound = static_cast<PluginMessage>(reader.number<std::uint8_t>()) == PluginMessage::count;
    const auto count = reader.number<std::uint64_t>();
    return sound ? std::clamp<std::size_t>(count, 1, CommandHistory::capacity) : 1;
}

/// The same question has the same answer: whoever steps back over it need not wait for it to hang once more.
std::string IsolatedController::failedAt(std::string message, Failure failure) const {
    if (failed_.size() == mostFailed) failed_.pop_front();
    failed_.push_back({std::move(message), failure});
    return failure;
}

tl::expected<std::string, std::string> IsolatedController::askOnce(const std::string& message) const {
    for (const Failed& known : failed_)
        if (known.message == message) return tl::unexpected(known.failure);
    auto answer = ask(message);
    if (!answer) return tl::unexpected(failedAt(message, answer.error()));
    return answer;
}

tl::expected<void, std::string> IsolatedController::askDecision(const Observation& observation,
                                                                std::span<std::byte> memory, Decision& decision) const {
    std::string message = begin(PluginMessage::decide);
    appendObservation(observation, message);
    message.append(reinterpret_cast<const char*>(memory.data()), memory.size());
    const auto answer = askOnce(message);
    if (!answer) return tl::unexpected(answer.error());
    ByteReader reader(*answer);
    if (static_cast<PluginMessage>(reader.number<std::uint8_t>()) != PluginMessage::decided ||
        !readDecision(reader, decision) || reader.rest().size() != memory.size()) {
        process_.reset();
        return tl::unexpected(failedAt(std::move(message), nonsense));
    }
    std::memcpy(memory.data(), reader.rest().data(), memory.size());
    return {};
}

tl::expected<std::vector<MemoryEntry>, std::string> IsolatedController::askExplanation(
    std::span<const std::byte> memory) const {
    std::string message = begin(PluginMessage::explain);
    message.append(reinterpret_cast<const char*>(memory.data()), memory.size());
    const auto answer = askOnce(message);
    if (!answer) return tl::unexpected(answer.error());
    ByteReader reader(*answer);
    std::vector<MemoryEntry> entries;
    if (static_cast<PluginMessage>(reader.number<std::uint8_t>()) != PluginMessage::explained ||
        !readEntries(reader, entries) || !reader.done()) {
        process_.reset();
        return tl::unexpected(failedAt(std::move(message), nonsense));
    }
    return entries;
}

/// Of a state that is shown or a condition that is asked: what fails here is no fault of the run.
void IsolatedController::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    if (as<PluginMemory>(memory).ended != 0) return;
    const std::lock_guard lock(turn_);
    const auto all = askExplanation(memory);
    if (!all) return entries.add("explain", "its plug-in " + all.error());
    for (const MemoryEntry& entry : *all) entries.add(entry);
}

void IsolatedController::decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const {
    if (as<PluginMemory>(memory).ended != 0) {
        decision.command = Command{};
        return;
    }
    const std::lock_guard lock(turn_);
    const auto asked = askDecision(observation, memory, decision);
    if (asked) return;
    as<PluginMemory>(memory).ended = 1;
    decision.clear();
    decision.fault = "its plug-in " + path_ + ' ' + asked.error();
}

Expected<std::shared_ptr<const IsolatedController>> isolatePlugin(const std::string& path, const std::string& options,
                                                                  const IsolationOptions& isolation) {
    const std::shared_ptr<IsolatedController> controller(new IsolatedController(path, options, isolation));
    auto opened = controller->open();
    if (!opened) return tl::unexpected(opened.error());
    controller->startMemory_ = std::move(opened->memory);
    controller->attention_ = opened->attention;
    return controller;
}

}  // namespace mrose
