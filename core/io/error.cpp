#include "io/error.h"

namespace mrose {

std::string Error::message() const {
    std::string text = file;
    if (line > 0) text += ':' + std::to_string(line);
    if (line > 0 && column > 0) text += ':' + std::to_string(column);
    if (!text.empty()) text += ": ";
    if (!key.empty()) text += key + ": ";
    return text + cause;
}

}  // namespace mrose
