#pragma once

#include <QString>
#include <string>

namespace mrose {

/// Words of core as Qt has them.
inline QString qtText(const std::string& words) { return QString::fromStdString(words); }

}  // namespace mrose
