#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <H5Cpp.h>

namespace samara::test {

// What a stranger may do to an HDF5 file with HDF5's own library. Names are absolute paths of the file.

/// Puts an attribute of `count` zeros of the type in place of the one that is there; `count` 0: a null space.
void put_attribute(const std::filesystem::path& file, const std::string& object, const std::string& name,
                   const H5::DataType& type, hsize_t count);

/// Puts a dataset of that shape in place of the one that is there: one whose values were never written. A
/// shape of more than a few thousand values needs a chunk in `creation`.
void put_dataset(const std::filesystem::path& file, const std::string& name, const H5::DataType& type,
                 const std::vector<hsize_t>& shape, const H5::DSetCreatPropList& creation = {});

/// Chunks of that shape, which nothing is stored of until they are written.
H5::DSetCreatPropList in_chunks(const std::vector<hsize_t>& chunk);

/// Values in another file, `bytes` of them from its beginning.
H5::DSetCreatPropList in_other_file(const std::filesystem::path& other, hsize_t bytes);

/// Values of the dataset `name` of the shape in another file.
H5::DSetCreatPropList in_dataset_of(const std::filesystem::path& other, const std::string& name,
                                    const std::vector<hsize_t>& shape);

/// Puts a link to `name` of another file, or of this one where `other` is empty, in place of what is there.
void put_link(const std::filesystem::path& file, const std::string& place, const std::string& name,
              const std::filesystem::path& other = {});

}  // namespace samara::test
