#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "geometry/shape.h"
#include "io/error.h"
#include "io/toml_table.h"
#include "motion/learned_model.h"
#include "scenario/description_source.h"

namespace mrose {

/// Reads each description file once and keeps what was read. For .cpp files of loaders: it shows TomlTable.
class DescriptionLibrary {
public:
    explicit DescriptionLibrary(DescriptionSource& source) : source_(source) {}

    /// A file that another one refers to.
    struct File {
        std::string name;   ///< for joining further names
        std::string shown;  ///< for errors
        std::string_view text;
    };
    /// The file that `table` of the file `from` names by `key`: seen from that file's folder, otherwise of those that
    /// ship in `folder` ("shapes"); never `from` itself. Where there is none, the table remembers the error.
    const File* file(TomlTable& table, std::string_view key, const std::string& from, std::string_view folder);
    /// The file of exactly that name, otherwise the one of that name that ships, seen from the folder of all that does
    /// or from one of `folders`. Error: there is none, with all places looked at; or several ship.
    Expected<const File*> file(const std::string& name, std::span<const std::string_view> folders);

    /// Shapes and networks are shared by all that name them. Errors of these files become the table's.
    std::shared_ptr<const Shape> shape(TomlTable& table, std::string_view key, const std::string& from);
    const MotionNetwork* network(TomlTable& table, std::string_view key, const std::string& from);
    /// One of these networks made ready for use, once for each dead time: that of the network, so much later.
    std::shared_ptr<const LearnedMotion> motion(const MotionNetwork& network, Nanoseconds laterV, Nanoseconds laterW);
    /// An excerpt of a log; nothing where there is no such log.
    Expected<const File*> excerpt(const LogExcerpt& excerpt);

    std::string shown(const std::string& name) const { return source_.shown(name); }
    /// Of all files that were read, by name.
    const std::map<std::string, std::string>& texts() const { return texts_; }

private:
    Expected<const File*> open(const std::string& name);

    DescriptionSource& source_;
    std::map<std::string, std::string> texts_;
    std::map<std::string, File> files_;
    std::map<std::string, std::shared_ptr<const Shape>> shapes_;
    std::map<std::string, MotionNetwork> networks_;
    std::map<std::tuple<const MotionNetwork*, Nanoseconds, Nanoseconds>, std::shared_ptr<const LearnedMotion>> motions_;
};

}  // namespace mrose
