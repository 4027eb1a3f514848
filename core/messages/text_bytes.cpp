#include "messages/text_bytes.h"

namespace mrose {

void appendCount(std::string& bytes, std::uint64_t value) {
    for (; value >= 128; value >>= 7) bytes += static_cast<char>(value | 128);
    bytes += static_cast<char>(value);
}

std::uint64_t readCount(ByteReader& reader) {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 63; shift += 7) {
        const auto byte = reader.number<std::uint8_t>();
        value |= std::uint64_t{byte & 127u} << shift;
        if (byte >= 128) continue;
        if (byte == 0 && shift > 0) reader.fail();  // it would have been written shorter
        return value;
    }
    reader.fail();
    return 0;
}

void appendText(std::string_view text, std::string& bytes) {
    appendCount(bytes, text.size());
    bytes += text;
}

bool readText(ByteReader& reader, std::string& text) {
    text = reader.take(readCount(reader));
    return !reader.failed();
}

}  // namespace mrose
