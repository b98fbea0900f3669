#pragma once

#include <filesystem>
#include <string>

namespace samara {

/// What check_file() found of a sound file.
struct CheckedFile {
    std::string kind;         ///< "body", "motion" or "wind"
    bool has_digest = false;  ///< whether the file holds a digest of its content; without one only HDF5's own
                              ///< checks can find damage
};

/// Reads a body, motion or wind file to its end, as the commands do, in a process of its own that can do
/// nothing else (run_confined), so that nothing that a file holds can harm this one. Throws Error where a
/// reader rejects it, where the process crashes, hangs or takes too much memory, and where the system offers
/// no such process.
CheckedFile check_file(const std::filesystem::path& file);

/// While an object of this class lives, this process checks as check_file() does, once, every HDF5 file that
/// it did not write before it opens it itself (Hdf5Reader::set_check), without the values of a motion's
/// poses, which take the most time. Does nothing where the system offers no such process. For programs, not
/// for libraries, which share the process of their caller.
class CheckBeforeReading {
  public:
    CheckBeforeReading();
    ~CheckBeforeReading();
    CheckBeforeReading(const CheckBeforeReading&) = delete;
    CheckBeforeReading& operator=(const CheckBeforeReading&) = delete;
};

}  // namespace samara
