#pragma once

#include <filesystem>
#include <string>

namespace samara {

/// What a file of an OpenFOAM case holds, uncompressed.
struct FoamBytes {
    std::filesystem::path path;  ///< the file that was read: the one asked for, or that with ".gz"
    std::string text;
};

/// Whether the file or its compressed copy FILE.gz exists.
bool foam_file_exists(const std::filesystem::path& file);

/// Reads the file whole, or, where only FILE.gz exists (OpenFOAM's writeCompression), unpacks that. Throws
/// Error where there is neither, and where the compressed file is cut short, damaged or of another kind.
FoamBytes read_foam_bytes(const std::filesystem::path& file);

}  // namespace samara
