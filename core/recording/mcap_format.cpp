#include "recording/mcap_format.h"

namespace mrose::mcap {

void appendStrings(std::string& bytes, const Strings& strings) {
    std::string content;
    for (const auto& [key, value] : strings) {
        appendText(content, key);
        appendText(content, value);
    }
    appendText(bytes, content);
}

Strings readStrings(ByteReader& reader) {
    ByteReader content(readText(reader));
    Strings strings;
    while (!content.failed() && !content.rest().empty()) {
        const std::string_view key = readText(content), value = readText(content);
        if (!content.failed()) strings.emplace(key, value);
    }
    return strings;
}

}  // namespace mrose::mcap
