#include "io/error.h"

namespace mrose {

std::string Error::message() const {
    std::string text = file;
    if (line > 0) text += ':' + std::to_string(line);
    if (line > 0 && column > 0) text += ':' + std::to_string(column);
    if (!text.empty()) text += ": ";
    if (!key.empty()) text += key + ": ";
    text += cause;
    // Names and values come from files: whatever they hold, a message stays one line and leaves a terminal alone.
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return text;
}

}  // namespace mrose
