#include "plugin/load_plugin.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <filesystem>

#include <dlfcn.h>

#include "io/toml_table.h"
#include "plugin/network_mapping.h"
#include "plugin/plugin.h"
#include "world/absurd_command.h"
#include "world/command_history.h"

namespace mrose {
namespace {

constexpr std::size_t mostMemory = 1 << 20;

/// Landmarks, and the names that they point to.
struct KnownLandmarks {
    std::vector<std::unique_ptr<const std::string>> names;
    std::vector<PluginLandmark> all;
};

class TableOptions final : public PluginOptions {
public:
    TableOptions(TomlTable& table, const std::string& path, std::vector<std::unique_ptr<const LearnedMapping>>& kept,
                 KnownLandmarks& landmarks)
        : table_(table), mappings_(table.tableOrEmpty(mappingsKey)), path_(path), kept_(kept), landmarks_(landmarks) {
        for (TomlTable& landmark : table.tablesOrNone(landmarksKey)) {
            const auto& name =
                landmarks_.names.emplace_back(std::make_unique<const std::string>(landmark.string("name")));
            landmarks_.all.push_back({name->c_str(), landmark.number("x_m"), landmark.number("y_m")});
        }
    }
    double number(const char* key, double fallback) override { return table_.numberOr(key, fallback); }
    bool flag(const char* key, bool fallback) override { return table_.booleanOr(key, fallback); }
    std::string text(const char* key, const char* fallback) override { return table_.stringOr(key, fallback); }
    const LearnedMapping* mapping(const char* key) override {
        if (!mappings_.has(key)) return nullptr;
        auto mapping = parseMapping(mappings_.string(key), path_);
        if (mapping) return kept_.emplace_back(std::make_unique<const NetworkMapping>(std::move(*mapping))).get();
        const Error& error = mapping.error();
        mappings_.reject(key, "is no network of a task: line " + std::to_string(error.line) + ": " +
                                  (error.key.empty() ? "" : error.key + ": ") + error.cause);
        return nullptr;
    }
    const PluginLandmark* landmark(std::uint32_t index) override {
        return index < landmarks_.all.size() ? &landmarks_.all[index] : nullptr;
    }
    void reject(const char* key, const char* cause) override {
        (mappings_.has(key) ? mappings_ : table_).reject(key, cause);
    }
    void rejectUnknown() {
        mappings_.rejectUnknown();
        table_.rejectUnknown();
    }

private:
    TomlTable& table_;
    TomlTable mappings_;
    const std::string& path_;
    std::vector<std::unique_ptr<const LearnedMapping>>& kept_;
    KnownLandmarks& landmarks_;
};

/// Runs what a plug-in has; gives what it threw, and "" where it did not.
template <class Function>
std::string thrownBy(Function function) {
    try {
        function();
        return "";
    } catch (const std::exception& error) {
        return std::string("threw: ") + error.what();
    } catch (...) {
        return "threw something that is no std::exception";
    }
}

std::string sizeCause(const char* what, std::uint32_t theirs, std::uint32_t ours) {
    return std::string("was built where ") + what + " has " + std::to_string(theirs) + " bytes and not " +
           std::to_string(ours) + "; build it with the headers of this program";
}

/// Why a plug-in does not fit this program; "" where it does.
std::string incompatibility(const PluginDescriptor& theirs) {
    if (theirs.interface != pluginInterface)
        return "was built for plug-in interface " + std::to_string(theirs.interface) + " and not " +
               std::to_string(pluginInterface) + "; build it with the headers of this program";
    if (std::strcmp(theirs.standardLibrary, MROSE_STANDARD_LIBRARY) != 0)
        return "was built with " + std::string(theirs.standardLibrary) + " and not with " MROSE_STANDARD_LIBRARY;
    const PluginLayout ours;
    const struct {
        const char* name;
        std::uint32_t PluginLayout::*size;
    } parts[] = {{"Observation", &PluginLayout::observation},
                 {"Reading", &PluginLayout::reading},
                 {"RecordType", &PluginLayout::recordType},
                 {"RecordField", &PluginLayout::recordField},
                 {"SeenBody", &PluginLayout::seenBody},
                 {"Decision", &PluginLayout::decision},
                 {"Annotation", &PluginLayout::annotation},
                 {"Kick", &PluginLayout::kick},
                 {"StampedCommand", &PluginLayout::stampedCommand},
                 {"RadioMessage", &PluginLayout::radioMessage},
                 {"ReceivedMessage", &PluginLayout::receivedMessage},
                 {"Attention", &PluginLayout::attention},
                 {"MemoryEntry", &PluginLayout::memoryEntry},
                 {"MemoryEntries", &PluginLayout::memoryEntries},
                 {"EntryName", &PluginLayout::entryName},
                 {"Command", &PluginLayout::command},
                 {"MappingVariable", &PluginLayout::mappingVariable}};
    for (const auto& [name, size] : parts)
        if (theirs.layout.*size != ours.*size) return sizeCause(name, theirs.layout.*size, ours.*size);
    return "";
}

/// What dlerror says, without the path in front.
std::string loadingCause(const std::string& path) {
    std::string cause = ::dlerror();
    if (cause.starts_with(path + ": ")) cause.erase(0, path.size() + 2);
    return "cannot be loaded: " + cause;
}

bool tooLarge(const RadioMessage& message) { return message.size > RadioMessage::most; }

/// What is wrong with the first command with which something is.
std::string commandCause(const Decision& decision) {
    std::string cause = decision.command ? absurdity(*decision.command) : "";
    for (std::size_t i = 0; cause.empty() && i < decision.earlier.size(); ++i)
        cause = absurdity(decision.earlier[i].command);
    return cause;
}

}  // namespace

struct PluginController::Library {
    void* handle = nullptr;
    const PluginDescriptor* descriptor = nullptr;
    std::vector<std::unique_ptr<const LearnedMapping>> mappings;  ///< that the controller calls
    KnownLandmarks landmarks;
    Controller* controller = nullptr;

    Library() = default;
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() {
        if (controller != nullptr) descriptor->destroy(controller);
        if (handle != nullptr) ::dlclose(handle);
    }
};

PluginController::PluginController(std::string path) : path_(std::move(path)), library_(std::make_unique<Library>()) {}
PluginController::~PluginController() = default;

Expected<void> PluginController::open(const std::string& options) {
    std::error_code ignored;
    if (!std::filesystem::exists(path_, ignored)) return fail(path_, "there is no such file");
    // A name without a folder would be searched for where the system's libraries are.
    const std::string absolute = std::filesystem::absolute(path_, ignored).string();
    library_->handle = ::dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_->handle == nullptr) return fail(path_, loadingCause(absolute));
    library_->descriptor = static_cast<const PluginDescriptor*>(::dlsym(library_->handle, "mrosePlugin"));
    if (library_->descriptor == nullptr) return fail(path_, "is no plug-in: it has no mrosePlugin (MROSE_PLUGIN)");
    if (const std::string cause = incompatibility(*library_->descriptor); !cause.empty()) return fail(path_, cause);
    TomlTable table(options, path_);
    TableOptions reader(table, path_, library_->mappings, library_->landmarks);
    std::string thrown = thrownBy([&] { library_->controller = library_->descriptor->create(reader); });
    if (thrown.empty() || table.failed()) reader.rejectUnknown();
    if (table.failed()) return fail(path_, table.error().cause, 0, table.error().key);
    if (!thrown.empty()) return fail(path_, "its construction " + thrown);
    std::size_t size = 0;
    thrown = thrownBy([&] { size = library_->controller->memorySize(); });
    if (!thrown.empty()) return fail(path_, "its memorySize " + thrown);
    if (size > mostMemory)
        return fail(path_, "asks for " + std::to_string(size) + " bytes of memory; at most " +
                               std::to_string(mostMemory) + " can be had");
    startMemory_.assign(size, std::byte{});
    thrown = thrownBy([&] { library_->controller->start(startMemory_); });
    if (!thrown.empty()) return fail(path_, "its start " + thrown);
    thrown = thrownBy([&] { attention_ = library_->controller->attention(); });
    if (!thrown.empty()) return fail(path_, "its attention " + thrown);
    return {};
}

void PluginController::start(std::span<std::byte> memory) const {
    as<PluginMemory>(memory) = {};
    std::copy(startMemory_.begin(), startMemory_.end(), memory.begin() + sizeof(PluginMemory));
}

std::size_t PluginController::commandsPerPeriod(Nanoseconds period) const {
    std::size_t count = 1;
    thrownBy([&] { count = library_->controller->commandsPerPeriod(period); });
    return std::clamp<std::size_t>(count, 1, CommandHistory::capacity);
}

void PluginController::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    if (as<PluginMemory>(memory).ended != 0) return;
    const std::string thrown =
        thrownBy([&] { library_->controller->explain(memory.subspan(sizeof(PluginMemory)), entries); });
    if (!thrown.empty()) entries.add("explain", thrown);
}

void PluginController::decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const {
    if (as<PluginMemory>(memory).ended != 0) {
        decision.command = Command{};
        return;
    }
    const std::span<std::byte> own = memory.subspan(sizeof(PluginMemory));
    std::string cause = thrownBy([&] { library_->controller->decide(observation, own, decision); });
    if (cause.empty()) cause = commandCause(decision);
    if (cause.empty() && std::ranges::any_of(decision.messages, tooLarge)) cause = "sent a message that is too large";
    if (!cause.empty()) {
        decision.clear();
        decision.fault = "its plug-in " + path_ + ' ' + cause;
    }
    // One line, whatever they say.
    if (!decision.fault.empty()) decision.fault = Error{"", 0, 0, "", decision.fault}.message();
}

Expected<std::shared_ptr<const PluginController>> loadPlugin(const std::string& path, const std::string& options) {
    const std::shared_ptr<PluginController> controller(new PluginController(path));
    if (const auto opened = controller->open(options); !opened) return tl::unexpected(opened.error());
    return controller;
}

}  // namespace mrose
