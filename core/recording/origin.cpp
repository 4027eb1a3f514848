#include "recording/origin.h"

#include <array>
#include <cstring>

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif
#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

#include "recording/mrose_commit.h"

namespace mrose {
namespace {

#if defined(__x86_64__) || defined(__i386__)

std::string processorName() {
    std::array<unsigned, 12> words{};
    for (unsigned leaf = 0; leaf < 3; ++leaf) {
        unsigned* const w = words.data() + 4 * leaf;
        if (__get_cpuid(0x80000002u + leaf, w, w + 1, w + 2, w + 3) == 0) return "unknown";
    }
    char text[sizeof words + 1] = {};
    std::memcpy(text, words.data(), sizeof words);
    std::string name = text;
    name.erase(name.find_last_not_of(' ') + 1);
    name.erase(0, name.find_first_not_of(' '));
    return name;
}

std::string instructionSetNames() {
    std::string names;
    const auto add = [&](const char* name, bool there) {
        if (there) names += (names.empty() ? "" : " ") + std::string(name);
    };
    // Those by which the C library and the networks' kernels choose their code.
    add("sse4.1", __builtin_cpu_supports("sse4.1"));
    add("avx", __builtin_cpu_supports("avx"));
    add("avx2", __builtin_cpu_supports("avx2"));
    add("fma", __builtin_cpu_supports("fma"));
    add("fma4", __builtin_cpu_supports("fma4"));
    add("avx512f", __builtin_cpu_supports("avx512f"));
    add("avx512dq", __builtin_cpu_supports("avx512dq"));
    add("avx512vl", __builtin_cpu_supports("avx512vl"));
    return names;
}

#else

std::string processorName() { return "unknown"; }
std::string instructionSetNames() { return ""; }

#endif

std::string cLibraryName() {
#if defined(__GLIBC__)
    return std::string("glibc ") + gnu_get_libc_version();
#else
    return "unknown";
#endif
}

}  // namespace

Origin thisOrigin() {
    return {MROSE_VERSION,  MROSE_COMMIT,    MROSE_COMPILER,       MROSE_BUILD_TYPE,
            cLibraryName(), processorName(), instructionSetNames()};
}

std::vector<std::string> differences(const Origin& recorded, const Origin& here) {
    std::vector<std::string> sentences;
    const auto compare = [&](const char* what, const std::string& then, const std::string& now) {
        if (then != now)
            sentences.push_back("it was recorded " + (what + (' ' + (then.empty() ? "unknown" : then))) + "; this is " +
                                (now.empty() ? "unknown" : now));
    };
    compare("by mrose", recorded.version, here.version);
    compare("by a build of commit", recorded.commit, here.commit);
    compare("by a build by", recorded.compiler, here.compiler);
    compare("by a build of type", recorded.buildType, here.buildType);
    compare("with the C library", recorded.cLibrary, here.cLibrary);
    compare("on the processor", recorded.processor, here.processor);
    compare("with the instruction sets", recorded.instructionSets, here.instructionSets);
    return sentences;
}

}  // namespace mrose
