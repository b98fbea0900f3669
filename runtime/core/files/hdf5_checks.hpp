#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <H5Cpp.h>

namespace samara {

// What an HDF5 file says of its content, judged before any of the content is read (docs/security.md).

/// The number of values of a shape; nothing where 64 bits do not hold it.
std::optional<hsize_t> value_count(const std::vector<hsize_t>& shape);

/// The shape of a space, empty for a single value; nothing where the space holds none.
std::optional<std::vector<hsize_t>> shape_of(const H5::DataSpace& space);

/// Whether the type is a plain number: an IEEE 754 one of 4 or 8 bytes, an integer of 1 to 8 bytes.
bool is_real(const H5::DataType& type);
bool is_integer(const H5::DataType& type);

/// How many bytes of its file a dataset takes, or what is wrong with its storage, such as "is compressed".
struct StorageClaim {
    std::string error;  ///< empty where nothing is wrong
    hsize_t bytes = 0;
};

/// Wrong are: values kept in other files, compressed or otherwise encoded ones, texts of variable length and
/// other types that are no plain numbers, a shape that 64 bits do not count, and one whose values are not all
/// stored.
StorageClaim storage_claim(const H5::DataSet& dataset);

/// What is wrong with a chunk of a dataset whose storage_claim() is sound, such as "has a chunk of another
/// size than its values take"; empty where each is as long as its values and its checksum, which is not
/// passed over. HDF5 believes what a file says of a chunk's size, and reads past the end of a shorter one.
std::string error_of_chunks(const H5::DataSet& dataset);

/// What is wrong with an attribute that must be one plain number, or one text of fixed length that takes at
/// most `most_bytes`; empty where nothing is.
std::string error_of_number(const H5::Attribute& attribute, bool integer);
std::string error_of_text(const H5::Attribute& attribute, std::uint64_t most_bytes);

}  // namespace samara
