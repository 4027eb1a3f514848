#pragma once

#include <cmath>
#include <string>

#include "support/temporary_folder.h"

namespace mrose {

/// A folder as the MRCLAM data sets have it: robots that each drive an arc of their own for a minute.
class MrclamFolder {
public:
    explicit MrclamFolder(int robots) {
        for (int robot = 1; robot <= robots; ++robot) {
            std::string sent = "# Time [s] v w\n", reached = "# Time [s] x y heading\n";
            const double speed = 0.05 + 0.02 * robot, turning = 0.1;
            for (int i = 0; i <= 600; ++i) sent += stamp(0.1 * i) + number(speed) + number(turning) + '\n';
            for (int i = 0; i <= 1500; ++i) {
                const double t = 0.04 * i, heading = turning * t, radius = speed / turning;
                reached += stamp(t) + number(robot + radius * std::sin(heading)) +
                           number(-robot - radius * std::cos(heading)) + number(heading) + '\n';
            }
            write(robot, "Odometry", sent);
            write(robot, "Groundtruth", reached);
        }
    }

    std::string path() const { return (folder_.path() / name).string(); }
    void write(int robot, const std::string& what, const std::string& text) const {
        folder_.write(name + std::string("/Robot") + std::to_string(robot) + '_' + what + ".dat", text);
    }

private:
    static constexpr const char* name = "MRCLAM_Dataset1";
    static std::string stamp(double seconds) {
        return std::to_string(1'248'444'187 + static_cast<int>(seconds)) +
               number(seconds - std::floor(seconds)).substr(2);
    }
    static std::string number(double value) { return ' ' + std::to_string(value); }

    TemporaryFolder folder_;
};

}  // namespace mrose
