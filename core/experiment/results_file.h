#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "io/error.h"

namespace mrose {

/// Which run of a batch or an experiment.
struct RunKey {
    std::uint32_t trial = 0;
    std::uint64_t seed = 0;
    std::uint32_t variant = 0;  ///< of an experiment, from 1; 0: of a batch
    friend bool operator<(const RunKey& a, const RunKey& b) {
        return std::tie(a.trial, a.variant, a.seed) < std::tie(b.trial, b.variant, b.seed);
    }
};

/// What the runs of a batch depend on but for trial and seed, each by its name: {"--duration", "60.0"}. Of contents, by
/// the names that begin with `contentOf`, the values are hashes.
using BatchIdentity = std::map<std::string, std::string>;
constexpr std::string_view contentOf = "content of ";

/// The rows of a batch on disk: each is kept as soon as it is there, in results.part.csv; all of them in order become
/// results.csv. A file batch.txt says which batch the folder belongs to; who works in the folder has it locked, so that
/// it is never replaced.
class ResultsFile {
public:
    /// Opens a folder, made where it is missing, with the rows that an earlier call has left. A row cut off by a kill
    /// is dropped. `identity` is the batch's; an open one has the folder for itself. Error: what the system says; the
    /// folder belongs to another batch, with what differs, or to none, or is in use.
    static Expected<ResultsFile> open(const std::filesystem::path& folder, const BatchIdentity& identity,
                                      const std::string& header);
    ~ResultsFile();
    ResultsFile(ResultsFile&& other) noexcept;
    ResultsFile& operator=(ResultsFile&&) = delete;

    bool has(const RunKey& key) const { return rows_.contains(key); }
    const std::map<RunKey, std::string>& rows() const { return rows_; }
    /// Error: there is a row that is not asked for now: it must neither get lost nor stand among the results. `take`:
    /// what would take it in.
    Expected<void> checkAsked(const std::function<bool(const RunKey&)>& asked, const std::string& take) const;
    /// `row` begins with trial and seed, of an experiment with the variant behind them, and is one line; after this a
    /// kill does not lose it.
    Expected<void> add(const RunKey& key, const std::string& row);
    /// Writes results.csv and removes results.part.csv.
    Expected<void> finish();

private:
    ResultsFile(std::filesystem::path folder, std::string header)
        : folder_(std::move(folder)), header_(std::move(header)) {}
    std::filesystem::path part() const { return folder_ / "results.part.csv"; }
    std::filesystem::path batch() const { return folder_ / "batch.txt"; }
    Expected<void> lock();
    Expected<void> checkIdentity(const BatchIdentity& identity);
    Expected<void> writeIdentity(const BatchIdentity& identity) const;
    Expected<void> readRows(const std::filesystem::path& path);

    std::filesystem::path folder_;
    std::string header_;
    std::map<RunKey, std::string> rows_;
    int descriptor_ = -1, lock_ = -1;  ///< of results.part.csv, of batch.txt
};

}  // namespace mrose
