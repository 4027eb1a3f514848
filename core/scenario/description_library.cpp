#include "scenario/description_library.h"

#include <vector>

#include "scenario/delayed_network.h"
#include "scenario/shape_file.h"

namespace mrose {
namespace {

std::string shippedFolder(std::string_view folder) {
    return std::string(shippedPrefix) + std::string(folder) + (folder.empty() ? "" : "/");
}

}  // namespace

Expected<const DescriptionLibrary::File*> DescriptionLibrary::open(const std::string& name) {
    if (const auto found = files_.find(name); found != files_.end()) return &found->second;
    auto text = source_.text(name);
    if (!text) return tl::unexpected(text.error());
    if (!*text) return nullptr;
    const std::string& kept = texts_.emplace(name, std::move(**text)).first->second;
    return &files_.emplace(name, File{name, source_.shown(name), kept}).first->second;
}

Expected<const DescriptionLibrary::File*> DescriptionLibrary::file(const std::string& name,
                                                                   std::span<const std::string_view> folders) {
    if (auto given = open(name); !given || *given != nullptr) return given;
    std::vector<std::string> places{joinedName(shippedFolder(""), name)};
    for (const std::string_view folder : folders) places.push_back(joinedName(shippedFolder(folder), name));
    std::erase(places, name);  // absolute, or as recordings call it
    const File* found = nullptr;
    std::string looked, several;
    for (const std::string& place : places) {
        const auto shipped = open(place);
        if (!shipped) return tl::unexpected(shipped.error());
        looked += (looked.empty() ? ", nor does " : " or ") + source_.shown(place);
        if (*shipped == nullptr) continue;
        several += (several.empty() ? "" : " and ") + place.substr(shippedPrefix.size());
        if (found != nullptr)
            return fail(name, "several files of that name ship: " + several + "; expected one of them");
        found = *shipped;
    }
    if (found != nullptr) return found;
    return fail(source_.shown(name), "does not exist" + looked);
}

const DescriptionLibrary::File* DescriptionLibrary::file(TomlTable& table, std::string_view key,
                                                         const std::string& from, std::string_view folder) {
    const std::string reference = table.string(key);
    if (table.failed()) return nullptr;
    const std::string beside = joinedName(from, reference);
    const std::string shipped = joinedName(shippedFolder(folder), reference);
    for (const std::string& name : {beside, shipped}) {
        if (name == from) continue;  // a robot file and its shape file may be called the same
        const auto found = open(name);
        if (!found) table.adopt(found.error());
        if (!found || *found != nullptr) return found.value_or(nullptr);
    }
    table.reject(key, '"' + reference + "\" was not found; expected " + source_.shown(beside) +
                          (beside == shipped ? "" : " or " + source_.shown(shipped)));
    return nullptr;
}

std::shared_ptr<const Shape> DescriptionLibrary::shape(TomlTable& table, std::string_view key,
                                                       const std::string& from) {
    const File* file = this->file(table, key, from, "shapes");
    if (file == nullptr) return nullptr;
    std::shared_ptr<const Shape>& shape = shapes_[file->name];
    if (shape) return shape;
    auto parsed = parseShape(file->text, file->shown);
    if (!parsed) return table.adopt(parsed.error()), nullptr;
    return shape = std::make_shared<const Shape>(std::move(*parsed));
}

const MotionNetwork* DescriptionLibrary::network(TomlTable& table, std::string_view key, const std::string& from) {
    const File* file = this->file(table, key, from, "nets");
    if (file == nullptr) return nullptr;
    if (const auto found = networks_.find(file->name); found != networks_.end()) return &found->second;
    auto parsed = parseNetwork(file->text, file->shown);
    if (!parsed) return table.adopt(parsed.error()), nullptr;
    return &networks_.emplace(file->name, std::move(*parsed)).first->second;
}

std::shared_ptr<const LearnedMotion> DescriptionLibrary::motion(const MotionNetwork& network, Nanoseconds laterV,
                                                                Nanoseconds laterW) {
    std::shared_ptr<const LearnedMotion>& motion = motions_[{&network, laterV, laterW}];
    if (!motion) motion = std::make_shared<const LearnedMotion>(delayed(network, laterV, laterW));
    return motion;
}

Expected<const DescriptionLibrary::File*> DescriptionLibrary::excerpt(const LogExcerpt& excerpt) {
    const std::string name = excerpt.name();
    if (const auto found = files_.find(name); found != files_.end()) return &found->second;
    auto text = source_.excerpt(excerpt);
    if (!text) return tl::unexpected(text.error());
    if (!*text) return nullptr;
    const std::string& kept = texts_.emplace(name, std::move(**text)).first->second;
    return &files_.emplace(name, File{name, name, kept}).first->second;
}

}  // namespace mrose
