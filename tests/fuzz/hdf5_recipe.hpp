#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace samara::fuzz {

// Damaged metadata make libhdf5 itself crash, and most random bytes fail its checksums. So the fuzzers of
// HDF5 files begin from a sound file and change what it holds through libhdf5: they try the checks of samara,
// which see every name, type, shape and value that a file can hold, and not libhdf5's own parsing.

/// A sound file: its bytes and the places in it, objects ("/surface/vertices") and attributes
/// ("/surface@source").
struct SeedFile {
    std::string bytes;
    std::vector<std::string> places;
};

/// Reads what the harness begins from.
SeedFile read_seed_file(const std::filesystem::path& file);

/// The file that the harness begins from; each harness of HDF5 files defines it.
const SeedFile& seed_file();

/// Changes the file as the recipe says, line by line; a line that says nothing, or asks what HDF5 does not
/// do, is passed over. The lines (NAME: a place; a number may be nan, inf or too large for the type):
///
///   delete NAME | rename NAME NAME | link NAME NAME | external NAME FILE NAME | group NAME
///   type NAME f64|f32|i8|u8|i32|u32|i64|u64|text|vtext|array|compound|opaque
///   shape NAME [N ...]          (none: a scalar; values are repeated; too many are not written)
///   number NAME INDEX NUMBER    (one of the values)
///   fill NAME NUMBER
///   text NAME WORDS
///   chunk NAME checked|plain|growing|deflated|edges ROWS [BYTES [MASK]]
///       (the values in chunks of so many rows of the longest axis; the first is then stored as BYTES zeros
///       with the filters that MASK leaves, the second as what makes up the sum; after all other lines)
void apply_recipe(std::string_view recipe, const std::filesystem::path& file);

}  // namespace samara::fuzz
