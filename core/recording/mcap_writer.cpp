#include "recording/mcap_writer.h"

#include <algorithm>
#include <cassert>

#include "io/compression.h"
#include "recording/crc32.h"

namespace mrose::mcap {
namespace {

constexpr std::string_view compressionName = "zstd";

void appendCounts(std::string& bytes, const std::map<std::uint16_t, std::uint64_t>& counts) {
    std::string content;
    for (const auto& [key, value] : counts) {
        appendNumber(content, key);
        appendNumber(content, value);
    }
    appendText(bytes, content);
}

}  // namespace

Expected<Writer> Writer::create(const std::filesystem::path& path, bool overwrite, std::string_view library) {
    Expected<OutputFile> file = OutputFile::create(path, overwrite);
    if (!file) return tl::unexpected(file.error());
    std::string header;
    appendText(header, "");
    appendText(header, library);
    file->write(std::string(magic) + record(Kind::header, header));
    return Writer(std::move(*file));
}

std::string Writer::record(Kind kind, std::string_view content) {
    std::string bytes;
    appendRecord(bytes, kind, content);
    return bytes;
}

std::uint16_t Writer::addSchema(std::string_view name, std::string_view encoding, std::string_view text) {
    std::string content;
    appendNumber(content, ++schemaCount_);
    appendText(content, name);
    appendText(content, encoding);
    appendText(content, text);
    write(Kind::schema, content);
    appendRecord(schemas_, Kind::schema, content);
    return schemaCount_;
}

std::uint16_t Writer::addChannel(std::uint16_t schema, std::string_view topic, std::string_view encoding) {
    std::string content;
    appendNumber(content, ++channelCount_);
    appendNumber(content, schema);
    appendText(content, topic);
    appendText(content, encoding);
    appendStrings(content, {});
    write(Kind::channel, content);
    appendRecord(channels_, Kind::channel, content);
    messageCounts_[channelCount_] = 0;
    return channelCount_;
}

void Writer::addMessage(std::uint16_t channel, std::int64_t time, std::string_view data) {
    assert(time >= 0);
    if (!state()) return;
    chunkStart_ = chunk_.empty() ? time : std::min(chunkStart_, time);
    chunkEnd_ = chunk_.empty() ? time : std::max(chunkEnd_, time);
    chunkIndex_[channel].push_back({time, chunk_.size()});
    const std::uint64_t number = messageCounts_[channel]++;
    appendNumber(chunk_, Kind::message);
    appendNumber(chunk_, std::uint64_t{2 + 4 + 8 + 8 + data.size()});
    appendNumber(chunk_, channel);
    appendNumber(chunk_, static_cast<std::uint32_t>(number));
    appendNumber(chunk_, time);
    appendNumber(chunk_, time);
    chunk_ += data;
    start_ = messageCount_ == 0 ? time : std::min(start_, time);
    end_ = std::max(end_, time);
    ++messageCount_;
}

std::string Writer::writeMessageIndices(std::map<std::uint16_t, std::uint64_t>& offsets) const {
    std::string bytes;
    for (const auto& [channel, messages] : chunkIndex_) {
        std::string content, entries;
        for (const Indexed& message : messages) {
            appendNumber(entries, message.time);
            appendNumber(entries, message.offset);
        }
        appendNumber(content, channel);
        appendText(content, entries);
        offsets[channel] = bytes.size();
        appendRecord(bytes, Kind::messageIndex, content);
    }
    return bytes;
}

void Writer::endChunk() {
    if (chunk_.empty()) return;
    const std::string records = compressed(chunk_);
    std::string content;
    appendNumber(content, chunkStart_);
    appendNumber(content, chunkEnd_);
    appendNumber(content, std::uint64_t{chunk_.size()});
    appendNumber(content, crc32(chunk_));
    appendText(content, compressionName);
    appendNumber(content, std::uint64_t{records.size()});
    content += records;
    const std::string chunk = record(Kind::chunk, content);
    std::map<std::uint16_t, std::uint64_t> offsets;
    const std::string indices = writeMessageIndices(offsets);
    const std::uint64_t start = file_.size();
    file_.write(chunk + indices);
    for (auto& [channel, offset] : offsets) offset += start + chunk.size();

    std::string index;
    appendNumber(index, chunkStart_);
    appendNumber(index, chunkEnd_);
    appendNumber(index, start);
    appendNumber(index, std::uint64_t{chunk.size()});
    appendCounts(index, offsets);
    appendNumber(index, std::uint64_t{indices.size()});
    appendText(index, compressionName);
    appendNumber(index, std::uint64_t{records.size()});
    appendNumber(index, std::uint64_t{chunk_.size()});
    appendRecord(chunkIndices_, Kind::chunkIndex, index);
    ++chunkCount_;
    chunk_.clear();
    chunkIndex_.clear();
}

void Writer::addAttachment(std::string_view name, std::string_view mediaType, std::int64_t time,
                           std::string_view data) {
    std::string content, index;
    appendNumber(content, time);
    appendNumber(content, std::int64_t{0});
    appendText(content, name);
    appendText(content, mediaType);
    appendNumber(content, std::uint64_t{data.size()});
    content += data;
    appendNumber(content, crc32(content));
    appendNumber(index, file_.size());
    appendNumber(index, std::uint64_t{recordHead + content.size()});
    appendNumber(index, time);
    appendNumber(index, std::int64_t{0});
    appendNumber(index, std::uint64_t{data.size()});
    appendText(index, name);
    appendText(index, mediaType);
    write(Kind::attachment, content);
    appendRecord(attachmentIndices_, Kind::attachmentIndex, index);
    ++attachmentCount_;
}

void Writer::addMetadata(std::string_view name, const Strings& strings) {
    std::string content, index;
    appendText(content, name);
    appendStrings(content, strings);
    appendNumber(index, file_.size());
    appendNumber(index, std::uint64_t{recordHead + content.size()});
    appendText(index, name);
    write(Kind::metadata, content);
    appendRecord(metadataIndices_, Kind::metadataIndex, index);
    ++metadataCount_;
}

void Writer::sync() { file_.sync(); }

std::string Writer::statistics() const {
    std::string content;
    appendNumber(content, messageCount_);
    appendNumber(content, schemaCount_);
    appendNumber(content, std::uint32_t{channelCount_});
    appendNumber(content, attachmentCount_);
    appendNumber(content, metadataCount_);
    appendNumber(content, chunkCount_);
    appendNumber(content, start_);
    appendNumber(content, end_);
    appendCounts(content, messageCounts_);
    return record(Kind::statistics, content);
}

/// Summary, summary offsets, footer and magic, as they lie from `start` on.
std::string Writer::summary(std::uint64_t start) const {
    const std::pair<Kind, std::string> groups[] = {{Kind::schema, schemas_},
                                                   {Kind::channel, channels_},
                                                   {Kind::statistics, statistics()},
                                                   {Kind::attachmentIndex, attachmentIndices_},
                                                   {Kind::metadataIndex, metadataIndices_},
                                                   {Kind::chunkIndex, chunkIndices_}};
    std::string bytes, offsets;
    for (const auto& [kind, records] : groups) {
        if (records.empty()) continue;
        std::string offset;
        appendNumber(offset, kind);
        appendNumber(offset, start + bytes.size());
        appendNumber(offset, std::uint64_t{records.size()});
        appendRecord(offsets, Kind::summaryOffset, offset);
        bytes += records;
    }
    const std::uint64_t offsetStart = start + bytes.size();
    bytes += offsets;
    appendNumber(bytes, Kind::footer);
    appendNumber(bytes, std::uint64_t{8 + 8 + 4});
    appendNumber(bytes, start);
    appendNumber(bytes, offsetStart);
    appendNumber(bytes, crc32(bytes));
    return bytes + std::string(magic);
}

Expected<void> Writer::close() {
    endChunk();
    std::string crc;
    appendNumber(crc, file_.crc());
    const std::string end = record(Kind::dataEnd, crc);
    file_.write(end + summary(file_.size() + end.size()));
    return file_.close();
}

}  // namespace mrose::mcap
