#pragma once

// All that a controller in a shared library needs, together with control/controller.h. resources/plugins/README.md
// shows how to write one. Nothing has to be linked: what these headers declare is in the program that loads it.

#include <cstdint>
#include <initializer_list>
#include <string>
#include <type_traits>

#include "control/controller.h"
#include "control/learned_mapping.h"

namespace mrose {

/// A landmark of the scenario's environment, as learned cameras report it: by its place in the environment's list.
struct PluginLandmark {
    const char* name = "";
    double x = 0, y = 0;  ///< m, in the world's frame
};

/// What a scenario says about a plug-in's controller, in its tables `options` and `mappings`. A key of another type
/// than asked for, and one that is never asked for, refuse the plug-in with file, line and column.
class PluginOptions {
public:
    virtual double number(const char* key, double fallback) = 0;
    virtual bool flag(const char* key, bool fallback) = 0;
    virtual std::string text(const char* key, const char* fallback) = 0;
    /// The learned mapping that the scenario's table `mappings` names by `key`; nullptr: it names none. It lives as
    /// long as the controller does.
    virtual const LearnedMapping* mapping(const char* key) = 0;
    /// The same, which must read and give what is named here, in this order, and be learned where it will be asked, but
    /// for a twentieth of that range (hardlyBeyond): mapping("time", {{"distance", 0, 3}, "bearing"}, {"time_s"});
    /// otherwise the plug-in is refused.
    const LearnedMapping* mapping(const char* key, std::initializer_list<AskedInput> inputs,
                                  std::initializer_list<const char*> outputs);
    /// The landmark that SeenBody::index means in a reading NAME.landmarks; nullptr: there are not so many. It lives as
    /// long as the controller does.
    virtual const PluginLandmark* landmark(std::uint32_t index) = 0;
    /// Refuses the plug-in because of the value of `key`.
    virtual void reject(const char* key, const char* cause) = 0;

protected:
    ~PluginOptions() = default;
};

inline const LearnedMapping* PluginOptions::mapping(const char* key, std::initializer_list<AskedInput> inputs,
                                                    std::initializer_list<const char*> outputs) {
    const LearnedMapping* const found = mapping(key);
    if (found == nullptr) return nullptr;
    std::string cause = mismatch(*found, inputs, outputs);
    if (cause.empty()) cause = learnedTooNarrowly(*found, inputs);
    if (cause.empty()) return found;
    reject(key, cause.c_str());
    return nullptr;
}

/// Grows with every change of what plug-ins and programs share: these declarations, control/controller.h and what it
/// includes.
constexpr std::uint32_t pluginInterface = 10;

/// Sizes of what goes from the one to the other.
struct PluginLayout {
    std::uint32_t observation = sizeof(Observation), reading = sizeof(Reading), recordType = sizeof(RecordType),
                  recordField = sizeof(RecordField), seenBody = sizeof(SeenBody), decision = sizeof(Decision),
                  annotation = sizeof(Annotation), kick = sizeof(Kick), stampedCommand = sizeof(StampedCommand),
                  radioMessage = sizeof(RadioMessage), receivedMessage = sizeof(ReceivedMessage),
                  attention = sizeof(Attention), memoryEntry = sizeof(MemoryEntry),
                  memoryEntries = sizeof(MemoryEntries), entryName = sizeof(EntryName), command = sizeof(Command),
                  mappingVariable = sizeof(MappingVariable);
};

#if defined(_LIBCPP_ABI_VERSION)
#define MROSE_STANDARD_LIBRARY "libc++"
#elif defined(_GLIBCXX_DEBUG)
#define MROSE_STANDARD_LIBRARY "libstdc++ with debugging containers"
#elif defined(__GLIBCXX__) && _GLIBCXX_USE_CXX11_ABI
#define MROSE_STANDARD_LIBRARY "libstdc++"
#elif defined(__GLIBCXX__)
#define MROSE_STANDARD_LIBRARY "libstdc++ with strings from before C++11"
#else
#define MROSE_STANDARD_LIBRARY "another standard library"
#endif

/// What a plug-in exports, under the name mrosePlugin.
struct PluginDescriptor {
    std::uint32_t interface = pluginInterface;  ///< stays first, whatever else changes
    const char* standardLibrary = MROSE_STANDARD_LIBRARY;
    PluginLayout layout;
    Controller* (*create)(PluginOptions& options) = nullptr;
    void (*destroy)(Controller* controller) = nullptr;
};

/// Of a controller that is made from options, or from nothing.
template <class Type>
constexpr PluginDescriptor describePlugin() {
    static_assert(std::is_base_of_v<Controller, Type>);
    PluginDescriptor descriptor;
    descriptor.create = [](PluginOptions& options) -> Controller* {
        if constexpr (std::is_constructible_v<Type, PluginOptions&>)
            return new Type(options);
        else
            return new Type();
    };
    descriptor.destroy = [](Controller* controller) { delete controller; };
    return descriptor;
}

}  // namespace mrose

/// Stands once in a plug-in, outside all namespaces.
#define MROSE_PLUGIN(Type)                                                                   \
    extern "C" {                                                                             \
    extern const mrose::PluginDescriptor mrosePlugin __attribute__((visibility("default"))); \
    constinit const mrose::PluginDescriptor mrosePlugin = mrose::describePlugin<Type>();     \
    }
