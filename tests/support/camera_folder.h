#pragma once

#include "support/mrclam_folder.h"

namespace mrose {

/// An MRCLAM folder of one robot that drives circles for four minutes, and whose camera looks every 0.236 s at
/// landmarks all around it.
class CameraFolder : public MrclamFolder {
public:
    CameraFolder();
};

}  // namespace mrose
