#include "io/compression.h"

#include <cassert>
#include <memory>

#include <zstd.h>

namespace mrose {

std::string compressed(std::string_view bytes) {
    constexpr int level = 1;
    std::string out(ZSTD_compressBound(bytes.size()), '\0');
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
    const std::size_t size = ZSTD_compress2(context.get(), out.data(), out.size(), bytes.data(), bytes.size());
    assert(!ZSTD_isError(size));
    out.resize(size);
    return out;
}

std::optional<std::string> decompressed(std::string_view bytes, std::size_t most) {
    const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) return std::nullopt;
    // A block, which takes 4 bytes at least, gives 128 KB at most.
    constexpr std::size_t mostPerByte = 128 * 1024 / 4;
    if (size > most || size / mostPerByte > bytes.size()) return std::nullopt;
    std::string out(size, '\0');
    const std::size_t got = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(got) || got != size) return std::nullopt;
    return out;
}

}  // namespace mrose
