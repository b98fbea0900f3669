#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <H5Cpp.h>

namespace samara {

// Checks of what an HDF5 file claims about its content, before any of the content is read
// (docs/explanation/security.md).

/// Returns the number of values of a shape; nothing where it exceeds 64 bits.
std::optional<hsize_t> value_count(const std::vector<hsize_t>& shape);

/// Returns the shape of a data space, empty for a single value; nothing where the space holds none.
std::optional<std::vector<hsize_t>> shape_of(const H5::DataSpace& space);

/// Returns whether the type is a plain number: an IEEE 754 number of 4 or 8 bytes, or an integer of 1 to 8
/// bytes.
bool is_real(const H5::DataType& type);
bool is_integer(const H5::DataType& type);

/// The bytes of its file that a dataset takes, or what is wrong with its storage, such as "is compressed".
struct StorageClaim {
    std::string error;  ///< empty where nothing is wrong
    hsize_t bytes = 0;
};

/// Returns the storage that a dataset claims. An error are: values kept in other files, compressed or
/// otherwise encoded ones, texts of variable length and other types that are no plain numbers, a shape of
/// more values than 64 bits count, and one whose values are not all stored.
StorageClaim storage_claim(const H5::DataSet& dataset);

/// Returns what is wrong with a chunk of a dataset whose storage_claim() is sound, such as "has a chunk of
/// another size than its values take"; empty where each chunk is as long as its values and its checksum,
/// which must not be skipped. HDF5 trusts a chunk's size in the file, and reads past the end of a shorter
/// chunk.
std::string error_of_chunks(const H5::DataSet& dataset);

/// Returns what is wrong with an attribute that must be one plain number, or one text of fixed length of at
/// most `most_bytes`; empty where nothing is.
std::string error_of_number(const H5::Attribute& attribute, bool integer);
std::string error_of_text(const H5::Attribute& attribute, std::uint64_t most_bytes);

/// Returns the space of a dataset with the block of `shape` at `offset` selected.
H5::DataSpace selected_block(const H5::DataSet& dataset, const std::vector<hsize_t>& offset,
                             const std::vector<hsize_t>& shape);

}  // namespace samara
