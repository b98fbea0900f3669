#pragma once

#include <filesystem>
#include <string>

namespace samara {

/// What a sound file of samara's is.
struct CheckedFile {
    std::string kind;         ///< "body", "motion" or "wind"
    bool has_digest = false;  ///< of its content; without it damage is found by what HDF5 checks alone
};

/// Reads a body, motion or wind file to its end, as the commands do, in a process of its own that can do
/// nothing else (run_confined), so that nothing that a file holds can harm this one. Throws Error where a
/// reader refuses it, where it crashes, hangs or takes too much memory, and where the system offers no such
/// process.
CheckedFile check_file(const std::filesystem::path& file);

/// While it lives, this process does the same, once, with every HDF5 file that it did not write before it
/// opens it itself (Hdf5Reader::set_check), without the values of a motion's poses, which take the most time.
/// Nothing where the system offers no such process. For programs, not for libraries: whoever calls these has
/// a process of its own to look after.
class CheckBeforeReading {
  public:
    CheckBeforeReading();
    ~CheckBeforeReading();
    CheckBeforeReading(const CheckBeforeReading&) = delete;
    CheckBeforeReading& operator=(const CheckBeforeReading&) = delete;
};

}  // namespace samara
