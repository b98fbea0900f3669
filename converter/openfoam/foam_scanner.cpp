#include "converter/openfoam/foam_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>
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
        fmt::format("{}: {}; copy the file again, or write it again with OpenFOAM", file.string(), what));
}

/// Decompresses gzip data of one member or several.
class Inflation {
  public:
    explicit Inflation(const std::filesystem::path& file) : file_(file) {
        // 15: the largest window; 16 more: gzip's header and checksum.
        if (inflateInit2(&stream_, 15 + 16) != Z_OK) throw damage(file_, "zlib could not be initialised");
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
            if (status == Z_STREAM_END) inflateReset(&stream_);  // the next member, as of concatenated files
            status = inflate_block(text);
        } while (status != Z_STREAM_END || waiting > 0 || stream_.avail_in > 0);
        return text;
    }

  private:
    /// Passes more of the `waiting` bytes to zlib, which counts in 32 bits, once it has consumed the previous
    /// ones.
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
        // zlib could make no progress: the input has ended.
        if (status == Z_BUF_ERROR) throw damage(file_, "the compressed file is truncated");
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
    if (!packed.starts_with("\x1f\x8b")) throw damage(compressed, "is not compressed with gzip");
    return {compressed, Inflation(compressed).inflated(std::move(packed))};
}

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

bool ends_word(char c) {
    return is_blank(c) || std::string_view("(){}[];\"").find(c) != std::string_view::npos;
}

}  // namespace

FoamScanner::FoamScanner(const std::filesystem::path& file) : FoamScanner(read_foam_bytes(file)) {}

FoamScanner::FoamScanner(FoamBytes bytes) : path_(std::move(bytes.path)), text_(std::move(bytes.text)) {}

void FoamScanner::skip_comment() {
    const bool to_line_end = text_[place_ + 1] == '/';
    const std::size_t end = to_line_end ? text_.find('\n', place_) : text_.find("*/", place_ + 2);
    if (end == std::string::npos && !to_line_end) throw error("this comment has no end");
    place_ = end == std::string::npos ? text_.size() : end + (to_line_end ? 1 : 2);
}

void FoamScanner::skip_blanks() {
    while (place_ < text_.size()) {
        if (is_blank(text_[place_])) {
            ++place_;
        } else if (text_.compare(place_, 2, "//") == 0 || text_.compare(place_, 2, "/*") == 0) {
            skip_comment();
        } else {
            return;
        }
    }
}

bool FoamScanner::at_end() {
    skip_blanks();
    return place_ == text_.size();
}

char FoamScanner::peek() {
    return at_end() ? '\0' : text_[place_];
}

bool FoamScanner::accept(char symbol) {
    if (peek() != symbol) return false;
    ++place_;
    return true;
}

void FoamScanner::expect(char symbol) {
    if (!accept(symbol)) throw error(fmt::format("expected '{}', found {}", symbol, found()));
}

std::string_view FoamScanner::word() {
    skip_blanks();
    const std::size_t start = place_;
    if (start < text_.size() && text_[start] == '"') {
        const std::size_t end = text_.find('"', start + 1);
        if (end == std::string::npos) throw error("this string has no closing quotation mark");
        place_ = end + 1;
        return std::string_view(text_).substr(start + 1, end - start - 1);
    }
    while (place_ < text_.size() && !ends_word(text_[place_])) ++place_;
    if (place_ == start) throw error(fmt::format("expected a word, found {}", found()));
    return std::string_view(text_).substr(start, place_ - start);
}

double FoamScanner::number() {
    skip_blanks();
    double value = 0.0;
    const char* const start = text_.data() + place_;
    const char* const end = read_foam_number(start, text_.data() + text_.size(), value);
    if (end == start || (*end != '\0' && !ends_word(*end))) {
        throw error(fmt::format("expected a number, found {}", found()));
    }
    place_ += static_cast<std::size_t>(end - start);
    return value;
}

std::int64_t FoamScanner::integer() {
    skip_blanks();
    std::int64_t value = 0;
    const char* const start = text_.data() + place_;
    const auto [end, status] = std::from_chars(start, text_.data() + text_.size(), value);
    if (status != std::errc() || (*end != '\0' && !ends_word(*end))) {
        throw error(fmt::format("expected a whole number, found {}", found()));
    }
    place_ += static_cast<std::size_t>(end - start);
    return value;
}

std::string_view FoamScanner::text_before(char symbol) {
    skip_blanks();
    const std::size_t start = place_;
    int depth = 0;
    for (; place_ < text_.size(); ++place_) {
        const char c = text_[place_];
        if (c == symbol && depth == 0) {
            std::size_t end = place_++;
            while (end > start && is_blank(text_[end - 1])) --end;
            return std::string_view(text_).substr(start, end - start);
        }
        if (c == '"') {
            place_ = std::min(text_.find('"', place_ + 1), text_.size() - 1);
        } else if (c == '(' || c == '{' || c == '[') {
            ++depth;
        } else if ((c == ')' || c == '}' || c == ']') && --depth < 0) {
            break;
        }
    }
    place_ = start;
    throw error(fmt::format("this entry does not end with '{}'", symbol));
}

std::string_view FoamScanner::bytes(std::size_t count) {
    if (count > text_.size() - place_) {
        throw error(fmt::format("the file ends {} bytes too early", count - (text_.size() - place_)));
    }
    const std::string_view block = std::string_view(text_).substr(place_, count);
    place_ += count;
    return block;
}

std::string FoamScanner::found() const {
    if (place_ >= text_.size()) return "the end of the file";
    std::size_t end = place_ + 1;
    while (end < text_.size() && end - place_ < 24 && !ends_word(text_[end])) ++end;
    return fmt::format("'{}'", text_.substr(place_, end - place_));
}

Error FoamScanner::error(std::string_view what) const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(place_, text_.size()));
    const auto line = 1 + std::count(text_.begin(), end, '\n');
    return Error(fmt::format("{}:{}: {}", path_.string(), line, what));
}

const char* read_foam_number(const char* first, const char* last, double& value) {
    const auto [end, status] = std::from_chars(first, last, value);
    // std::from_chars leaves the value unchanged then.
    if (status == std::errc::result_out_of_range)
        value = std::strtod(std::string(first, end).c_str(), nullptr);
    return status == std::errc::invalid_argument ? first : end;
}

}  // namespace samara
