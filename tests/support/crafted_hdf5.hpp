#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <H5Cpp.h>

namespace samara::test {

// Changes that an attacker may make to an HDF5 file with HDF5's own library. Names are absolute paths of the
// file.

/// Puts an attribute of `count` zeros of the type in place of the one that is there; `count` 0: a null space.
void put_attribute(const std::filesystem::path& file, const std::string& object, const std::string& name,
                   const H5::DataType& type, hsize_t count);

/// Puts a dataset of that shape in place of the one that is there: one whose values were never written. A
/// shape of more than a few thousand values needs a chunk in `creation`.
void put_dataset(const std::filesystem::path& file, const std::string& name, const H5::DataType& type,
                 const std::vector<hsize_t>& shape, const H5::DSetCreatPropList& creation = {});

/// Returns chunks of that shape, of which nothing is stored until they are written.
H5::DSetCreatPropList in_chunks(const std::vector<hsize_t>& chunk);

/// The layout of a dataset's chunks. HDF5 finds them by another index for each `growing` and each format.
struct ChunkLayout {
    std::vector<hsize_t> chunk;  ///< shape of each
    bool has_checksum = true;    ///< fletcher32 behind each
    std::size_t growing = 0;     ///< that many of the first axes may grow
};

/// A new file, in HDF5's latest format or in its oldest, with one dataset /values: doubles from 1 up.
void make_hdf5(const std::filesystem::path& file, const std::vector<hsize_t>& shape, bool in_latest_format);

/// The content in place of the chunk that begins at `place`: zeros, written past the filters, which are
/// marked as skipped where `mask` is 1.
struct CraftedChunk {
    std::vector<hsize_t> place;
    std::size_t bytes = 0;
    std::uint32_t mask = 0;
};

/// Stores the values of a dataset of doubles anew in chunks, some of them crafted. False where HDF5 writes no
/// such thing.
bool put_in_chunks(const std::filesystem::path& file, const std::string& name, const ChunkLayout& layout,
                   const std::vector<CraftedChunk>& crafted = {});

/// Stores a text in place of a dataset of bytes.
void put_text(const std::filesystem::path& file, const std::string& name, const std::string& text);

/// Returns storage in another file, `bytes` from its beginning.
H5::DSetCreatPropList in_other_file(const std::filesystem::path& other, hsize_t bytes);

/// Returns storage in the dataset `name` of another file.
H5::DSetCreatPropList in_dataset_of(const std::filesystem::path& other, const std::string& name,
                                    const std::vector<hsize_t>& shape);

/// Puts a link to `name` of another file, or of this one where `other` is empty, in place of what is there.
void put_link(const std::filesystem::path& file, const std::string& place, const std::string& name,
              const std::filesystem::path& other = {});

}  // namespace samara::test
