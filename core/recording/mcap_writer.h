#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "recording/mcap_format.h"
#include "recording/output_file.h"

namespace mrose::mcap {

/// Writes an MCAP file as it comes: attachments and metadata at once, messages in chunks (Zstandard, with CRC and
/// index), at the end a summary by which readers find everything. Until then the file holds whole records only, as far
/// as the disk has room: after an error it is cut back to the last of them, and nothing more is written.
class Writer {
public:
    /// Error: `path` exists and `overwrite` is false, or the file cannot be made.
    static Expected<Writer> create(const std::filesystem::path& path, bool overwrite, std::string_view library);

    /// An id for addChannel.
    std::uint16_t addSchema(std::string_view name, std::string_view encoding, std::string_view text);
    /// An id for addMessage.
    std::uint16_t addChannel(std::uint16_t schema, std::string_view topic, std::string_view encoding);
    /// Times must not be negative.
    void addMessage(std::uint16_t channel, std::int64_t time, std::string_view data);
    std::size_t pendingBytes() const { return chunk_.size(); }
    /// Ends the chunk, if any message is in it.
    void endChunk();
    void addAttachment(std::string_view name, std::string_view mediaType, std::int64_t time, std::string_view data);
    void addMetadata(std::string_view name, const Strings& strings);
    /// Waits until the disk has what was written.
    void sync();
    /// Ends the chunk and writes the summary. Nothing may be added afterwards.
    Expected<void> close();
    /// Nothing of it stays; nor may anything be added.
    void discard() { file_.discard(); }

    const Expected<void>& state() const { return file_.state(); }

private:
    explicit Writer(OutputFile file) : file_(std::move(file)) {}

    struct Indexed {
        std::int64_t time;
        std::uint64_t offset;
    };
    /// A copy of a record for the summary.
    void write(Kind kind, std::string_view content) { file_.write(record(kind, content)); }
    static std::string record(Kind kind, std::string_view content);
    /// Writes the messages' indices after their chunk; returns the offsets of the records.
    std::string writeMessageIndices(std::map<std::uint16_t, std::uint64_t>& offsets) const;
    std::string statistics() const;
    std::string summary(std::uint64_t start) const;

    OutputFile file_;
    std::string chunk_;
    std::map<std::uint16_t, std::vector<Indexed>> chunkIndex_;
    std::int64_t chunkStart_ = 0, chunkEnd_ = 0;
    std::string schemas_, channels_, chunkIndices_, attachmentIndices_, metadataIndices_;  ///< records of the summary
    std::map<std::uint16_t, std::uint64_t> messageCounts_;
    std::uint16_t schemaCount_ = 0, channelCount_ = 0;
    std::uint32_t attachmentCount_ = 0, metadataCount_ = 0, chunkCount_ = 0;
    std::int64_t start_ = 0, end_ = 0;
    std::uint64_t messageCount_ = 0;
};

}  // namespace mrose::mcap
