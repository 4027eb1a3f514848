#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

int main() {
    std::uint64_t sums[6] = {};
    for (int i = 1; i <= 1'000'000; ++i) {
        const double x = i * 0.000123;
        const double values[6] = {std::sin(x), std::cos(x),        std::exp(x),
                                  std::log(x), std::atan2(x, 2.0), std::pow(x, 1.7)};
        for (int k = 0; k < 6; ++k) sums[k] += std::bit_cast<std::uint64_t>(values[k]);
    }
    for (const std::uint64_t sum : sums) std::printf("%016llx\n", static_cast<unsigned long long>(sum));
}
