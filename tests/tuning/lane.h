#pragma once

#include <map>
#include <memory>
#include <string>

#include "experiment/experiment_file.h"
#include "io/toml_text.h"
#include "scenario/description_source.h"

namespace mrose {

/// Descriptions in memory of an experiment in which a robot drives straight on for 4 s, with noise that differs from
/// trial to trial: how far it is then from 1 m is `off`.
class Lane {
public:
    static constexpr const char* scenario = R"(format = "mrose scenario"
version = 1
name = "lane"
environment = "e.toml"
duration_s = 4.0
[[robot]]
name = "a"
type = "r.toml"
start = { x_m = 0.0, y_m = 0.0 }
controller = { kind = "velocity_script", commands = [{ t_s = 0, v_mps = 0.4 }] }
)";
    static constexpr const char* experiment = R"(format = "mrose experiment"
version = 1
name = "lane"
scenario = "s.toml"
trials = 3
seeds = 2
[[draw]]
name = "x"
path = "robot[1].start.x_m"
from = -0.1
to = 0.1
[measures]
off = 'abs(robot[1].x - 1)'
never = { first = 'robot[1].x > 100' }
)";
    static constexpr const char* head =
        "format = \"mrose tuning\"\nversion = 1\nname = \"how fast\"\nexperiment = \"x.toml\"\n";
    static constexpr const char* budget = "trials = 16\nheld_out = 20\nevaluations = 300\ncost = \"off\"\n";
    static constexpr const char* speed =
        "[[parameter]]\nname = \"speed\"\npath = \"robot[1].controller.commands[1].v_mps\"\nfrom = 0.05\nto = 0.5\n";

    std::map<std::string, std::string> texts{
        {"s.toml", scenario},
        {"x.toml", experiment},
        {"r.toml",
         "format = \"mrose robot\"\nversion = 1\nname = \"r\"\nshape = \"d.toml\"\nmass_kg = 10.0\n"
         "control_period_s = 0.1\n[kinematics]\n[motion_noise]\ndistance_per_distance = 0.05\n"},
        {"d.toml", "format = \"mrose shape\"\nversion = 1\nname = \"d\"\n[[part]]\ncircle = { radius_m = 0.2 }\n"},
        {"e.toml", "format = \"mrose environment\"\nversion = 1\nname = \"e\"\n"}};

    /// What a text of that name says, with the other ones at hand.
    Value::File file(const std::string& name, const std::string& text) {
        source_ = std::make_unique<KeptDescriptions>(texts);
        auto content = parseToml(text, name);
        return std::make_shared<const DescriptionFile>(
            DescriptionFile{name, name, content ? std::move(*content) : Value(Value::Table())});
    }
    DescriptionSource& source() { return *source_; }

private:
    std::unique_ptr<KeptDescriptions> source_;
};

}  // namespace mrose
