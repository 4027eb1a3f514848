#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mrose {

struct Include {
    std::string name;  ///< what stands between the quotes or brackets
    bool quoted = false;
    int line = 0;
};

/// A file of the repository's own C++.
struct SourceFile {
    std::string path;   ///< from the repository's root: "core/logs/log_reader.h"
    std::string layer;  ///< folder in core, or "app/cli", "app/gui", "widgets"; otherwise the top folder: "tests"
    bool header = false;
    int lines = 0;
    bool pragmaOnce = false;  ///< its first directive is #pragma once
    std::vector<Include> includes;

    /// "learning/rprop.h" for core/learning/rprop.cpp where that header exists beside it; otherwise empty.
    std::string ownHeader;
    std::string text;
};

SourceFile parseSource(const std::string& path, std::string_view text);

/// All .h and .cpp files below these top folders of the repository that exist, in the order of their names.
std::vector<SourceFile> sourceFiles(const std::vector<std::string>& folders);

}  // namespace mrose
