#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <H5Cpp.h>

namespace samara {

/// Writes one HDF5 file: library version "latest", fletcher32 on every dataset, no times, so that equal
/// content gives equal bytes and a flipped bit is found on reading. The groups of a dataset's path are made.
/// Names are absolute paths.
class Hdf5Writer {
  public:
    explicit Hdf5Writer(const std::filesystem::path& file);
    ~Hdf5Writer();
    Hdf5Writer(const Hdf5Writer&) = delete;
    Hdf5Writer& operator=(const Hdf5Writer&) = delete;

    /// Writes row-major values of the shape `dimensions`. `units` becomes the dataset's attribute of that
    /// name ("1" where the values have none), `meaning` its attribute "description".
    void write(const std::string& name, const std::vector<double>& values,
               const std::vector<hsize_t>& dimensions, std::string_view units, std::string_view meaning);
    void write(const std::string& name, const std::vector<std::int32_t>& values,
               const std::vector<hsize_t>& dimensions, std::string_view units, std::string_view meaning);
    /// Makes a dataset of doubles that is filled block by block: `dimensions` is its shape, `chunk` that of
    /// the pieces it is stored in. Blocks of whole chunks take the least time, and memory for one chunk.
    void reserve(const std::string& name, const std::vector<hsize_t>& dimensions,
                 const std::vector<hsize_t>& chunk, std::string_view units, std::string_view meaning);
    /// Writes row-major values of a block of the shape `shape` at `offset` in a reserved dataset.
    void write_block(const std::string& name, const std::vector<double>& values,
                     const std::vector<hsize_t>& offset, const std::vector<hsize_t>& shape);
    /// Cuts a reserved dataset to a smaller shape.
    void shorten(const std::string& name, const std::vector<hsize_t>& dimensions);
    /// Writes a text as a dataset of bytes (no limit on its length).
    void write_text(const std::string& name, std::string_view text, std::string_view meaning);

    void attribute(const std::string& object, const std::string& name, std::string_view text);
    void attribute(const std::string& object, const std::string& name, double value);
    void attribute(const std::string& object, const std::string& name, std::int64_t value);
    void attribute(const std::string& object, const std::string& name, std::uint64_t value);

    /// Reserves room on the disk for a file of this size, where the file system can. Throws Error where there
    /// is not enough.
    void expect_size(std::uintmax_t bytes);

    /// Hands all that was written to the system; throws H5::Exception where the disk is full.
    void flush();

    /// Gives up a file that cannot be completed: from here on nothing reaches the disk, so that HDF5 can
    /// close it.
    void abandon() noexcept;

  private:
    void write_values(const H5::DataSet& dataset, const void* values, const H5::DataType& type,
                      const H5::DataSpace& memory, const H5::DataSpace& place);
    [[nodiscard]] int descriptor() const;
    H5::Group group(const std::string& name);
    H5::DataSet dataset(const std::string& name, const H5::DataType& type,
                        const std::vector<hsize_t>& dimensions, const std::vector<hsize_t>& chunk,
                        std::string_view units, std::string_view meaning);

    std::filesystem::path path_;
    H5::H5File file_;
    bool has_room_ = false;  ///< whether reserved room must be given back
};

/// Writes an HDF5 file through replace_file(), with its digest: `fill` writes the content. Throws Error, also
/// in place of HDF5's own exceptions.
void write_hdf5(const std::filesystem::path& file, const std::function<void(Hdf5Writer&)>& fill);

}  // namespace samara
