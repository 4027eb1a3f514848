#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "logs/conditioning.h"
#include "logs/row_check.h"

namespace mrose {

/// Samples as they stand in the files. Those of the file that is being read come last, each with its place in the text.
template <class Sample>
struct CsvStream {
    std::vector<Sample> samples;
    std::vector<const char*> places;

    void add(Sample sample, const char* place) {
        samples.push_back(std::move(sample));
        places.push_back(place);
    }
};

/// To be called at the end of each file: brings its samples in order among those of earlier files. Error: they run
/// backwards in time for good.
template <class Sample>
Expected<void> endFile(CsvStream<Sample>& stream, std::string_view content, const std::string& name,
                       std::int64_t& outOfOrder) {
    const auto fresh = stream.samples.end() - static_cast<std::ptrdiff_t>(stream.places.size());
    if (!std::is_sorted(fresh, stream.samples.end(), earlier<Sample>)) {
        std::vector<Sample> added(fresh, stream.samples.end());
        const auto lineOf = [&](std::size_t row) { return positionIn(content, stream.places[row]).line; };
        if (auto checked = checkDirection(added, name, lineOf); !checked) return checked;
        LogDefects defects;
        sortByTime(added, defects);
        outOfOrder += defects.outOfOrder;
        std::copy(added.begin(), added.end(), fresh);
    }
    if (fresh != stream.samples.begin() && fresh != stream.samples.end() && earlier(*fresh, *std::prev(fresh)))
        std::inplace_merge(stream.samples.begin(), fresh, stream.samples.end(), earlier<Sample>);
    stream.places.clear();
    return {};
}

}  // namespace mrose
