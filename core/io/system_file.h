#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include <unistd.h>

namespace mrose {

// What the .cpp files of this folder share of the system's own files.

class FileDescriptor {
public:
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    ~FileDescriptor() { close(); }

    int value() const { return descriptor_; }
    bool close() {
        if (descriptor_ < 0) return true;
        const int result = ::close(descriptor_);
        descriptor_ = -1;
        return result == 0;
    }

private:
    int descriptor_;
};

/// What the system says of what failed just now.
inline std::string systemCause(const char* what) { return std::string(what) + ": " + std::strerror(errno); }

}  // namespace mrose
