#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace mrose {

// Binary files are little-endian, as every processor is that mrose runs on: numbers are copied as they lie.
static_assert(std::endian::native == std::endian::little);

/// Appends the bytes of a number.
template <class Number>
void appendNumber(std::string& bytes, Number value) {
    static_assert(std::is_arithmetic_v<Number> || std::is_enum_v<Number>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Reads numbers and runs of bytes off the front of a text, and never beyond its end: after the first read that does
/// not fit `failed()` holds and every further read gives zero or nothing.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <class Number>
    Number number() {
        static_assert(std::is_arithmetic_v<Number>);
        Number value{};
        if (const std::string_view bytes = take(sizeof value); !bytes.empty())
            std::memcpy(&value, bytes.data(), sizeof value);
        return value;
    }
    std::string_view take(std::uint64_t size) {
        if (size > rest_.size()) {
            failed_ = true;
            rest_ = {};
            return {};
        }
        const std::string_view bytes = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return bytes;
    }

    std::string_view rest() const { return rest_; }
    void fail() { failed_ = true; }  ///< what was read makes no sense
    bool failed() const { return failed_; }
    /// All of it was read, and no more.
    bool done() const { return !failed_ && rest_.empty(); }

private:
    std::string_view rest_;
    bool failed_ = false;
};

/// A text of any length: its size and its bytes.
inline void appendLong(std::string& bytes, std::string_view text) {
    appendNumber(bytes, std::uint64_t{text.size()});
    bytes += text;
}
inline std::string_view readLong(ByteReader& reader) { return reader.take(reader.number<std::uint64_t>()); }

}  // namespace mrose
