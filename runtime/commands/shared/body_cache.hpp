#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "samara/core/body/body.hpp"

namespace samara {

/// Bodies that were made of shapes, kept as body files in a folder of the user's own, so that the next run of
/// a scene does not mesh them again. Several processes may share it. It never fails: what cannot be kept or
/// read is made anew.
class BodyCache {
  public:
    /// What the folder may hold, bytes: beyond it those go that were longest not used.
    static constexpr std::uintmax_t usual_most_bytes = 1'000'000'000;

    /// The folder that SAMARA_CACHE names, else $XDG_CACHE_HOME/samara, else ~/.cache/samara. Keeps nothing
    /// where SAMARA_CACHE is "off", where there is no home, and where the folder cannot be made or is open to
    /// other users.
    explicit BodyCache(std::uintmax_t most_bytes = usual_most_bytes);

    /// The body that is kept for the key, which has to hold all that the body depends on. Nothing where there
    /// is none or where it is damaged.
    [[nodiscard]] std::optional<Body> find(const std::string& key) const;
    /// Keeps a body for the next time.
    void keep(const std::string& key, const Body& body) const;

  private:
    [[nodiscard]] std::filesystem::path entry_of(const std::string& key) const;
    void remove_oldest() const;

    std::optional<std::filesystem::path> folder_;
    std::uintmax_t most_bytes_;
};

/// All that the body made of a file depends on, but for what the caller adds: its name and bytes, samara's
/// version and which samara-mesh there is. Nothing where the file's bytes do not tell: a .geo may read other
/// files, the time or random numbers.
std::optional<std::string> body_key(const std::filesystem::path& file);

}  // namespace samara
