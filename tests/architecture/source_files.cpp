#include "architecture/source_files.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "support/places.h"

namespace mrose {
namespace {

std::string layerOf(const std::filesystem::path& path) {
    std::vector<std::string> parts;
    for (const auto& part : path) parts.push_back(part.string());
    if (parts.size() > 2 && parts[0] == "core") return parts[1];
    if (parts.size() > 2 && parts[0] == "app") return parts[0] + '/' + parts[1];
    return parts[0];
}

/// The header of a .cpp as includes name it: seen from core/, from the programs' own folders, from app/ where both
/// share it, or from the top.
std::string headerName(const std::filesystem::path& path) {
    const std::filesystem::path header = std::filesystem::path(path).replace_extension(".h");
    const std::string layer = layerOf(path);
    if (layer == "app/cli" || layer == "app/gui") return header.lexically_relative(layer).string();
    return *path.begin() == "widgets" ? header.string() : header.lexically_relative(*path.begin()).string();
}

}  // namespace

SourceFile parseSource(const std::string& path, std::string_view text) {
    static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
    static const std::regex directive(R"(^\s*#\s*(\w+)\s*(\w*).*)");
    SourceFile file{path, layerOf(path), path.ends_with(".h"), 0, false, {}, {}, std::string(text)};
    std::istringstream stream{file.text};
    bool anyDirective = false;
    for (std::string line; std::getline(stream, line);) {
        ++file.lines;
        std::smatch match;
        if (!anyDirective && std::regex_match(line, match, directive)) {
            anyDirective = true;
            file.pragmaOnce = match[1] == "pragma" && match[2] == "once";
        }
        if (std::regex_match(line, match, include)) file.includes.push_back({match[2], match[1] == "\"", file.lines});
    }
    return file;
}

std::vector<SourceFile> sourceFiles(const std::vector<std::string>& folders) {
    const std::filesystem::path root = sourceFolder();
    std::vector<SourceFile> files;
    for (const std::string& folder : folders) {
        if (!std::filesystem::is_directory(root / folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const std::filesystem::path& path = entry.path();
            if (path.extension() != ".h" && path.extension() != ".cpp") continue;
            std::ostringstream text;
            text << std::ifstream(path, std::ios::binary).rdbuf();
            const std::filesystem::path name = path.lexically_relative(root);
            files.push_back(parseSource(name.string(), text.str()));
            if (path.extension() == ".cpp" &&
                std::filesystem::exists(std::filesystem::path(path).replace_extension(".h")))
                files.back().ownHeader = headerName(name);
        }
    }
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    return files;
}

}  // namespace mrose
