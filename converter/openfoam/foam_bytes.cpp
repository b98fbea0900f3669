#include "converter/openfoam/foam_bytes.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {
namespace {

std::filesystem::path compressed_name(const std::filesystem::path& file) {
    return file.string() + ".gz";
}

Error damage(const std::filesystem::path& file, const char* what) {
    return Error(
        fmt::format("{}: {}; copy the file again, or let OpenFOAM write it again", file.string(), what));
}

/// Inflates gzip data of one member or several.
class Inflation {
  public:
    explicit Inflation(const std::filesystem::path& file) : file_(file) {
        // 15: the largest window; 16 more: gzip's header and checksum.
        if (inflateInit2(&stream_, 15 + 16) != Z_OK) throw damage(file_, "zlib could not start");
    }
    ~Inflation() { inflateEnd(&stream_); }
    Inflation(const Inflation&) = delete;
    Inflation& operator=(const Inflation&) = delete;

    std::string inflated(std::string packed) {
        std::string text;
        stream_.next_in = reinterpret_cast<Bytef*>(packed.data());
        std::size_t waiting = packed.size();
        int status = Z_OK;
        do {
            feed(waiting);
            if (status == Z_STREAM_END) inflateReset(&stream_);  // files may be joined
            status = inflate_block(text);
        } while (status != Z_STREAM_END || waiting > 0 || stream_.avail_in > 0);
        return text;
    }

  private:
    /// Shows zlib, which counts in 32 bits, more of the `waiting` bytes once it has taken all that it saw.
    void feed(std::size_t& waiting) {
        if (stream_.avail_in > 0) return;
        const std::size_t next = std::min<std::size_t>(waiting, std::numeric_limits<uInt>::max());
        stream_.avail_in = static_cast<uInt>(next);
        waiting -= next;
    }

    int inflate_block(std::string& text) {
        stream_.next_out = reinterpret_cast<Bytef*>(block_.data());
        stream_.avail_out = static_cast<uInt>(block_.size());
        const int status = inflate(&stream_, Z_NO_FLUSH);
        // Without progress there is neither input nor output left.
        if (status == Z_BUF_ERROR) throw damage(file_, "the compressed file is cut short");
        if (status != Z_OK && status != Z_STREAM_END) throw damage(file_, "the compressed file is damaged");
        text.append(block_, 0, block_.size() - stream_.avail_out);
        return status;
    }

    const std::filesystem::path& file_;
    z_stream stream_{};
    std::string block_ = std::string(std::size_t{1} << 18, '\0');
};

}  // namespace

bool foam_file_exists(const std::filesystem::path& file) {
    return std::filesystem::exists(file) || std::filesystem::exists(compressed_name(file));
}

FoamBytes read_foam_bytes(const std::filesystem::path& file) {
    const std::filesystem::path compressed = compressed_name(file);
    if (std::filesystem::exists(file) || !std::filesystem::exists(compressed)) {
        return {file, read_bytes(file)};
    }
    std::string packed = read_bytes(compressed);
    if (!packed.starts_with("\x1f\x8b")) throw damage(compressed, "is not compressed by gzip");
    return {compressed, Inflation(compressed).inflated(std::move(packed))};
}

}  // namespace samara
