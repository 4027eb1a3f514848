#include "recording/mcap_reader.h"

#include <optional>

#include "io/compression.h"
#include "recording/crc32.h"

namespace mrose::mcap {
namespace {

struct Record {
    Kind kind{};
    std::string_view content;
    std::uint64_t offset = 0;
};

/// The records of a file one after the other.
class Records {
public:
    explicit Records(std::string_view bytes) : bytes_(bytes), at_(magic.size()) {}

    /// Nothing at the end and where a record is cut short.
    std::optional<Record> next() {
        if (bytes_.size() - at_ < recordHead) return std::nullopt;
        ByteReader head(bytes_.substr(at_, recordHead));
        Record record{Kind{head.number<std::uint8_t>()}, {}, at_};
        const auto length = head.number<std::uint64_t>();
        if (length > bytes_.size() - at_ - recordHead) return std::nullopt;
        record.content = bytes_.substr(at_ + recordHead, length);
        at_ += recordHead + length;
        return record;
    }
    std::uint64_t offset() const { return at_; }

private:
    std::string_view bytes_;
    std::uint64_t at_;
};

std::string atByte(std::uint64_t offset) { return " at byte " + std::to_string(offset); }

/// A chunk's records; nullopt where it is damaged.
std::optional<std::string> recordsOf(std::string_view chunk) {
    ByteReader reader(chunk);
    reader.take(16);
    const auto size = reader.number<std::uint64_t>();
    const auto crc = reader.number<std::uint32_t>();
    const std::string_view compression = readText(reader);
    const std::string_view packed = reader.take(reader.number<std::uint64_t>());
    if (!reader.done() || (compression != "zstd" && !compression.empty())) return std::nullopt;
    std::optional<std::string> records = compression.empty() ? std::string(packed) : decompressed(packed);
    if (!records || records->size() != size || (crc != 0 && crc32(*records) != crc)) return std::nullopt;
    return records;
}

/// Whether it was sound.
bool readAttachment(const Record& record, Attachment& attachment) {
    ByteReader reader(record.content);
    attachment.offset = record.offset;
    attachment.time = reader.number<std::int64_t>();
    reader.number<std::int64_t>();
    attachment.name = readText(reader);
    attachment.mediaType = readText(reader);
    attachment.data = reader.take(reader.number<std::uint64_t>());
    const std::size_t covered = record.content.size() - reader.rest().size();
    const auto crc = reader.number<std::uint32_t>();
    return !reader.failed() && (crc == 0 || crc32(record.content.substr(0, covered)) == crc);
}

class Parser {
public:
    explicit Parser(std::string_view bytes) : bytes_(bytes), records_(bytes) {}

    Content parse() {
        while (const std::optional<Record> record = records_.next()) {
            if (record->kind == Kind::dataEnd) {
                checkEnd(*record);
                return std::move(content_);
            }
            if (!read(*record)) return std::move(content_);
        }
        checkChunks();
        content_.endless = true;
        content_.damage.push_back(records_.offset() == bytes_.size()
                                      ? "its end is missing: it is being written, or was not closed"
                                      : "it is cut off" + atByte(records_.offset()) + " of " +
                                            std::to_string(bytes_.size()));
        return std::move(content_);
    }

private:
    bool read(const Record& record) {
        if (record.kind == Kind::attachment) {
            Attachment attachment;
            if (!readAttachment(record, attachment)) {
                content_.damage.push_back("the attachment" + atByte(record.offset) +
                                          " is damaged: its bytes do not fit its CRC");
                return false;
            }
            content_.attachments.push_back(attachment);
        } else if (record.kind == Kind::metadata) {
            ByteReader reader(record.content);
            const std::string_view name = readText(reader);
            content_.metadata.emplace_back(name, readStrings(reader));
        } else if (record.kind == Kind::chunk) {
            chunks_.push_back(record);
        }
        return true;
    }

    void checkChunks() {
        for (const Record& chunk : chunks_)
            if (!recordsOf(chunk.content))
                content_.damage.push_back("the chunk" + atByte(chunk.offset) +
                                          " is damaged: its bytes do not fit its CRC");
    }

    void checkEnd(const Record& end) {
        const auto crc = ByteReader(end.content).number<std::uint32_t>();
        if (crc != 0 && crc32(bytes_.substr(0, end.offset)) != crc) {
            const std::size_t before = content_.damage.size();
            checkChunks();
            if (content_.damage.size() == before)
                content_.damage.push_back("its data, outside of chunks and attachments, do not fit their CRC");
        }
        if (!wholeSummary(records_.offset()))
            content_.damage.push_back("its summary" + atByte(records_.offset()) + " is damaged");
    }

    bool wholeSummary(std::uint64_t start) const {
        constexpr std::size_t footer = recordHead + 8 + 8 + 4;
        if (!bytes_.ends_with(magic) || bytes_.size() - start < footer + magic.size()) return false;
        const std::string_view summary = bytes_.substr(start, bytes_.size() - start - magic.size());
        ByteReader last(summary.substr(summary.size() - footer));
        if (Kind{last.number<std::uint8_t>()} != Kind::footer) return false;
        const auto crc = ByteReader(summary.substr(summary.size() - 4)).number<std::uint32_t>();
        return crc == 0 || crc32(summary.substr(0, summary.size() - 4)) == crc;
    }

    std::string_view bytes_;
    Records records_;
    Content content_;
    std::vector<Record> chunks_;
};

}  // namespace

Expected<Content> parse(std::string_view bytes, const std::string& name) {
    if (!bytes.starts_with(magic)) return fail(name, "is no MCAP file: it does not begin as one");
    return Parser(bytes).parse();
}

}  // namespace mrose::mcap
