#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "experiment/experiment.h"
#include "experiment/results_row.h"
#include "io/file.h"
#include "io/toml_text.h"
#include "support/temporary_folder.h"

namespace mrose::experiment_test {

inline constexpr const char* kept = R"(format = "mrose scenario"
version = 1
name = "lane"
environment = "e.toml"
duration_s = 4.0
[[robot]]
name = "a"
type = "r.toml"
start = { x_m = 0.0, y_m = 0.0 }
controller = { kind = "velocity_script", commands = [{ t_s = 0, v_mps = 0.4 }] }
[[object]]
name = "box 1"
kind = "box"
shape = "d.toml"
mass_kg = 5.0
start = { x_m = 0.0, y_m = 5.0 }
[[object]]
name = "box 2"
kind = "box"
shape = "d.toml"
mass_kg = 5.0
start = { x_m = 0.0, y_m = 7.0 }
)";
inline constexpr const char* robotFile = R"(format = "mrose robot"
version = 1
name = "r"
shape = "d.toml"
mass_kg = 10.0
control_period_s = 0.1
[kinematics]
[motion_noise]
distance_per_distance = 0.05
)";
inline constexpr const char* shapeFile =
    "format = \"mrose shape\"\nversion = 1\nname = \"d\"\n[[part]]\ncircle = { radius_m = 0.2 }\n";
inline constexpr const char* placeFile = "format = \"mrose environment\"\nversion = 1\nname = \"e\"\n";
inline constexpr const char* head =
    "format = \"mrose experiment\"\nversion = 1\nname = \"lane\"\nscenario = \"s.toml\"\n";

inline constexpr const char* drawn = R"(trials = 12
[[draw]]
name = "x"
path = "robot[1].start.x_m"
from = -3.0
to = 3.0
[[draw]]
name = "v"
path = "robot[1].controller.commands[1].v_mps"
of = [0.2, 0.4]
)";

/// `text` with another number of trials than 12.
inline std::string replacedTrials(std::string text, const std::string& trials) {
    return text.replace(text.find("trials = 12"), 11, "trials = " + trials);
}

/// An experiment of files in memory.
class ExperimentTest : public testing::Test {
protected:
    Expected<Experiment> read(const std::string& text) {
        std::map<std::string, std::string> texts{
            {"s.toml", scenario_}, {"r.toml", robotFile}, {"d.toml", shapeFile}, {"e.toml", placeFile}};
        texts.insert(more_.begin(), more_.end());
        source_ = std::make_unique<KeptDescriptions>(std::move(texts));
        auto content = parseToml(head + text, "x.toml");
        EXPECT_TRUE(content) << content.error().message();
        if (!content) return tl::unexpected(content.error());
        return readExperiment(
            std::make_shared<const DescriptionFile>(DescriptionFile{"x.toml", "x.toml", std::move(*content)}),
            *source_);
    }
    Experiment experiment(const std::string& text) {
        auto experiment = read(text);
        EXPECT_TRUE(experiment) << experiment.error().message();
        return experiment ? std::move(*experiment) : Experiment{};
    }
    std::string refusal(const std::string& text) {
        const auto experiment = read(text);
        return experiment ? "" : experiment.error().message();
    }
    Expected<ExperimentSummary> run(const Experiment& experiment, const std::string& name = "out") {
        return runExperiment(experiment, options_, folder_.path() / name);
    }
    std::string refusedRun(const std::string& text) {
        const Experiment read = experiment(text);
        const auto summary = run(read, "refused");
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "refused")) << text;
        return summary ? "" : summary.error().message();
    }
    std::string results(const std::string& name = "out") {
        return readFile(folder_.path() / name / "results.csv").value_or("none");
    }
    /// Rows by the names of their columns.
    std::vector<std::map<std::string, std::string>> rows(const std::string& name = "out") {
        std::vector<std::map<std::string, std::string>> all;
        std::vector<std::string> names;
        const std::string text = results(name);
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = text.find('\n', begin);
            const auto cells = resultsCells(std::string_view(text).substr(begin, end - begin));
            begin = end + 1;
            if (names.empty()) {
                names = cells;
                continue;
            }
            for (std::size_t i = 0; i < names.size(); ++i)
                i == 0 ? (void)all.emplace_back() : (void)0, all.back()[names[i]] = cells.at(i);
        }
        return all;
    }
    static double number(const std::string& text) { return std::stod(text); }

    std::string scenario_ = kept;
    std::map<std::string, std::string> more_;  ///< files, by name
    TemporaryFolder folder_;
    ExperimentOptions options_;
    std::unique_ptr<KeptDescriptions> source_;
};

}  // namespace mrose::experiment_test
