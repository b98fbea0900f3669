#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "samara/core/base/error.hpp"

namespace samara {

/// The uncompressed content of a file of an OpenFOAM case.
struct FoamBytes {
    std::filesystem::path path;  ///< the file that was read: the given one, or that with ".gz"
    std::string text;
};

/// Whether the file or its compressed copy FILE.gz exists.
bool foam_file_exists(const std::filesystem::path& file);

/// Reads the file whole, or, where only FILE.gz exists (OpenFOAM's writeCompression), unpacks that. Throws
/// Error where there is neither, and where the compressed file is truncated, damaged or not of gzip.
FoamBytes read_foam_bytes(const std::filesystem::path& file);

/// Reads the words, numbers and brackets of an OpenFOAM file one after another; blanks and comments between
/// them are skipped. Every Error names the file and the line.
class FoamScanner {
  public:
    /// Reads the file, or its compressed copy, whole (read_foam_bytes).
    explicit FoamScanner(const std::filesystem::path& file);

    /// The file that was read.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Whether nothing but blanks and comments is left.
    bool at_end();
    /// Returns the next character that is not blank; '\0' at the end.
    char peek();
    /// Skips `symbol` if it is next; returns whether it was.
    bool accept(char symbol);
    /// Skips `symbol`, or throws Error.
    void expect(char symbol);
    /// Returns the next word, or the next text in quotes (without them). Throws Error at a bracket, a
    /// semicolon or the end.
    std::string_view word();
    double number();
    std::int64_t integer();
    /// Returns the text up to the next `symbol` outside brackets and quotes, which is skipped, without blanks
    /// at both ends.
    std::string_view text_before(char symbol);
    /// Returns the next `count` bytes unchanged.
    std::string_view bytes(std::size_t count);

    /// Returns the error "FILE:LINE: what" for the place last read.
    [[nodiscard]] Error error(std::string_view what) const;

  private:
    explicit FoamScanner(FoamBytes bytes);
    void skip_blanks();
    void skip_comment();
    /// Describes the text at the current place for a message.
    [[nodiscard]] std::string found() const;

    std::filesystem::path path_;
    std::string text_;
    std::size_t place_ = 0;
};

/// Reads a number at the start of [first, last) as std::from_chars does, and returns where it ends; `first`
/// where there is none. A number too large for a double becomes infinite, one too small (OpenFOAM writes
/// 1e-320 in decaying fields) zero.
const char* read_foam_number(const char* first, const char* last, double& value);

}  // namespace samara
