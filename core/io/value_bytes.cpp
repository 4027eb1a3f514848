#include "io/value_bytes.h"

#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <xxhash.h>

#include "io/bytes.h"

namespace mrose {
namespace {

// A value is its kind and its content: numbers as they lie, texts with their sizes, arrays and tables with their
// numbers of elements, keys in their order. A file is its number among the files, which come first.
enum class Kind : std::uint8_t { none, no, yes, integer, real, text, array, table, file };
enum class FileKind : std::uint8_t { included, known };

constexpr int mostDepth = 64;
/// Of values within a value: each takes a byte of a file and some fifty of memory.
constexpr std::uint64_t mostValues = std::uint64_t{1} << 25;

using Hash = std::pair<std::uint64_t, std::uint64_t>;  // low and high half

void appendKind(std::string& bytes, Kind kind) { appendNumber(bytes, kind); }

/// `file` appends what stands for a file.
template <class AppendFile>
void append(const Value& value, std::string& bytes, const AppendFile& file) {
    if (const bool* const truth = value.asBoolean()) {
        appendKind(bytes, *truth ? Kind::yes : Kind::no);
    } else if (const std::int64_t* const integer = value.asInteger()) {
        appendKind(bytes, Kind::integer);
        appendNumber(bytes, *integer);
    } else if (const double* const real = value.asFloat()) {
        appendKind(bytes, Kind::real);
        appendNumber(bytes, *real);
    } else if (const std::string* const text = value.asText()) {
        appendKind(bytes, Kind::text);
        appendLong(bytes, *text);
    } else if (const Value::Array* const array = value.asArray()) {
        appendKind(bytes, Kind::array);
        appendNumber(bytes, std::uint64_t{array->size()});
        for (const Value& element : *array) append(element, bytes, file);
    } else if (const Value::Table* const table = value.asTable()) {
        appendKind(bytes, Kind::table);
        appendNumber(bytes, std::uint64_t{table->size()});
        for (const auto& [key, element] : *table) {
            appendLong(bytes, key);
            append(element, bytes, file);
        }
    } else if (value.asFile()) {
        appendKind(bytes, Kind::file);
        file(value.sharedFile());
    } else {
        appendKind(bytes, Kind::none);
    }
}

/// Hashes of files' contents, each computed once.
class Hashes {
public:
    Hash of(const DescriptionFile& file) {
        if (const auto found = known_.find(&file); found != known_.end()) return found->second;
        const Hash hash = of(file.content);
        return known_.emplace(&file, hash).first->second;
    }
    Hash of(const Value& value) {
        std::string bytes;
        append(value, bytes, [&](const Value::File& file) {
            const Hash hash = of(*file);
            appendNumber(bytes, hash.first);
            appendNumber(bytes, hash.second);
        });
        const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
        return {hash.low64, hash.high64};
    }

private:
    std::map<const DescriptionFile*, Hash> known_;
};

/// The files of a value, those of one content and name as one.
class Files {
public:
    void add(const Value& value) {
        if (const Value::Array* const array = value.asArray()) {
            for (const Value& element : *array) add(element);
        } else if (const Value::Table* const table = value.asTable()) {
            for (const auto& [key, element] : *table) add(element);
        } else if (const Value::File file = value.sharedFile(); file && !places_.contains(file.get())) {
            add(file->content);
            const auto [same, added] = numbers_.emplace(std::tuple(hashes_.of(*file), file->name, file->reference),
                                                        std::uint64_t{files_.size()});
            if (added) files_.push_back(file);
            places_.emplace(file.get(), same->second);
        }
    }
    std::uint64_t numberOf(const Value::File& file) const { return places_.at(file.get()); }
    std::vector<Value::File>& all() { return files_; }
    Hashes& hashes() { return hashes_; }

private:
    Hashes hashes_;
    std::map<std::tuple<Hash, std::string, std::string>, std::uint64_t> numbers_;
    std::map<const DescriptionFile*, std::uint64_t> places_;
    std::vector<Value::File> files_;
};

class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    std::optional<Value> read(std::span<const Value::File> known) {
        Hashes hashes;
        std::map<Hash, Value::File> byHash;
        for (const Value::File& file : known) byHash.emplace(hashes.of(*file), file);
        for (auto left = bytes_.number<std::uint64_t>(); left > 0 && sound(); --left) readFile(byHash);
        Value value = readValue(0);
        if (!sound() || !bytes_.done()) return {};
        return value;
    }

private:
    bool sound() const { return sound_ && !bytes_.failed(); }

    void readFile(const std::map<Hash, Value::File>& known) {
        DescriptionFile file;
        file.name = readLong(bytes_);
        file.reference = readLong(bytes_);
        const auto kind = static_cast<FileKind>(bytes_.number<std::uint8_t>());
        if (kind == FileKind::included) {
            file.content = readValue(0);
        } else {
            const auto low = bytes_.number<std::uint64_t>(), high = bytes_.number<std::uint64_t>();
            const auto found = known.find({low, high});
            sound_ = sound_ && kind == FileKind::known && found != known.end();
            if (!sound()) return;
            file.content = found->second->content;
            if (found->second->name == file.name && found->second->reference == file.reference)
                return files_.push_back(found->second);
        }
        files_.push_back(std::make_shared<const DescriptionFile>(std::move(file)));
    }

    Value readValue(int depth) {
        if (depth > mostDepth || ++values_ > mostValues) sound_ = false;
        if (!sound()) return {};
        switch (static_cast<Kind>(bytes_.number<std::uint8_t>())) {
            case Kind::none:
                return {};
            case Kind::no:
                return false;
            case Kind::yes:
                return true;
            case Kind::integer:
                return bytes_.number<std::int64_t>();
            case Kind::real:
                return bytes_.number<double>();
            case Kind::text:
                return std::string(readLong(bytes_));
            case Kind::array:
                return readArray(depth);
            case Kind::table:
                return readTable(depth);
            case Kind::file:
                return readFileNumber();
        }
        sound_ = false;
        return {};
    }

    Value readArray(int depth) {
        Value::Array array;
        for (auto left = bytes_.number<std::uint64_t>(); left > 0 && sound(); --left)
            array.push_back(readValue(depth + 1));
        return array;
    }

    Value readTable(int depth) {
        Value::Table table;
        for (auto left = bytes_.number<std::uint64_t>(); left > 0 && sound(); --left) {
            std::string key(readLong(bytes_));
            if (!table.empty() && key <= table.rbegin()->first) sound_ = false;
            table.emplace_hint(table.end(), std::move(key), readValue(depth + 1));
        }
        return table;
    }

    Value readFileNumber() {
        const auto number = bytes_.number<std::uint64_t>();
        if (number < files_.size()) return files_[number];
        sound_ = false;
        return {};
    }

    ByteReader bytes_;
    bool sound_ = true;
    std::uint64_t values_ = 0;
    std::vector<Value::File> files_;
};

}  // namespace

std::vector<Value::File> filesOf(const Value& value) {
    Files files;
    files.add(value);
    return std::move(files.all());
}

std::string valueBytes(const Value& value, std::span<const Value::File> known) {
    Files files;
    files.add(value);
    std::set<Hash> isKnown;
    for (const Value::File& file : known) isKnown.insert(files.hashes().of(*file));
    std::string bytes;
    const auto appendNumberOf = [&](const Value::File& file) { appendNumber(bytes, files.numberOf(file)); };
    appendNumber(bytes, std::uint64_t{files.all().size()});
    for (const Value::File& file : files.all()) {
        appendLong(bytes, file->name);
        appendLong(bytes, file->reference);
        const Hash hash = files.hashes().of(*file);
        appendNumber(bytes, isKnown.contains(hash) ? FileKind::known : FileKind::included);
        if (isKnown.contains(hash)) {
            appendNumber(bytes, hash.first);
            appendNumber(bytes, hash.second);
        } else {
            append(file->content, bytes, appendNumberOf);
        }
    }
    append(value, bytes, appendNumberOf);
    return bytes;
}

std::optional<Value> parseValue(std::string_view bytes, std::span<const Value::File> known) {
    return Reader(bytes).read(known);
}

std::uint64_t hashOf(const Value& value) { return Hashes().of(value).first; }

}  // namespace mrose
