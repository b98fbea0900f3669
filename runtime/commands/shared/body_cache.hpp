#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "samara/core/body/body.hpp"

namespace samara {

/// Bodies that were made of shapes, kept as body files in a folder of the user's own, so that the next run of
/// a scene does not mesh them again. Several processes may share it. It never fails: a body that cannot be
/// kept or read is made anew.
class BodyCache {
  public:
    /// Size (bytes) that the folder may have by default: beyond it the least recently used bodies are
    /// removed.
    static constexpr std::uintmax_t usual_most_bytes = 1'000'000'000;

    /// Opens the folder that SAMARA_CACHE names, else $XDG_CACHE_HOME/samara, else ~/.cache/samara. Keeps
    /// nothing where SAMARA_CACHE is "off", where there is no home, and where the folder cannot be made or is
    /// open to other users.
    explicit BodyCache(std::uintmax_t most_bytes = usual_most_bytes);

    /// Returns the body that is kept for the key, which must contain all that the body depends on. Nothing
    /// where there is none or where it is damaged.
    [[nodiscard]] std::optional<Body> find(const std::string& key) const;
    /// Keeps a body for the next time.
    void keep(const std::string& key, const Body& body) const;

  private:
    [[nodiscard]] std::filesystem::path entry_of(const std::string& key) const;
    void remove_oldest() const;

    std::optional<std::filesystem::path> folder_;
    std::uintmax_t most_bytes_;
};

/// Returns the key of the body made of a file, to which the caller adds its own settings: the file's name and
/// bytes, samara's version and the installed samara-mesh. Nothing where the body depends on more than the
/// bytes: a .geo may read other files, the time or random numbers.
std::optional<std::string> body_key(const std::filesystem::path& file);

}  // namespace samara
