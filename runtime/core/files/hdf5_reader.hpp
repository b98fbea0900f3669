#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <H5Cpp.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/input_file.hpp"

namespace samara {

/// Reads one HDF5 file that need not be trusted: every call checks links, types, shapes and sizes before it
/// takes memory or reads, and throws Error with the file's name, the place in it and the remedy where they do
/// not fit. Values in other files, and compressed or encoded ones, are rejected; all datasets together may
/// claim no more bytes than the file has. Calls from several threads must not overlap.
class Hdf5Reader {
  public:
    /// Opens the file. Throws Error where it cannot be opened, is no HDF5 file, or does not match its digest.
    /// A file without a digest, as earlier versions and other programs write it, is read too.
    explicit Hdf5Reader(const std::filesystem::path& file);

    /// Makes every later reader of this process call `check` with its file first, once for each state of a
    /// file. `check` throws Error where the file must not be opened here. nullptr, the default, as in
    /// libraries: no check.
    static void set_check(void (*check)(const InputFile& file));
    /// Marks the file in its present state as checked: this process wrote it.
    static void trust(const std::filesystem::path& file);

    /// Returns whether there is such a group or dataset.
    [[nodiscard]] bool has(const std::string& name) const;
    /// Returns the dataset's values, row-major. Throws Error where one is not finite. `dimensions`: the shape
    /// that it must have; 0 stands for any length.
    [[nodiscard]] std::vector<double> finite_doubles(const std::string& name,
                                                     const std::vector<hsize_t>& dimensions) const;
    /// Returns finite_doubles() of the block of the shape `shape` at `offset`, which must lie within the
    /// dataset.
    [[nodiscard]] std::vector<double> finite_block(const std::string& name,
                                                   const std::vector<hsize_t>& offset,
                                                   const std::vector<hsize_t>& shape) const;
    [[nodiscard]] std::vector<std::int32_t> integers(const std::string& name,
                                                     const std::vector<hsize_t>& dimensions) const;
    [[nodiscard]] std::string text(const std::string& name) const;
    /// Returns text(). Throws Error where it exceeds the size and depth of error_of_json_size().
    [[nodiscard]] std::string json_text(const std::string& name) const;
    [[nodiscard]] std::vector<hsize_t> shape(const std::string& name) const;
    /// Returns the names of the groups and datasets in a group, sorted.
    [[nodiscard]] std::vector<std::string> children(const std::string& group) const;

    /// Throws Error where the dataset does not have this shape.
    void require_shape(const std::string& name, const std::vector<hsize_t>& dimensions) const;
    [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
    [[nodiscard]] std::string text_attribute(const std::string& object, const std::string& name) const;
    [[nodiscard]] double number_attribute(const std::string& object, const std::string& name) const;
    [[nodiscard]] std::int64_t integer_attribute(const std::string& object, const std::string& name) const;
    [[nodiscard]] std::uint64_t unsigned_attribute(const std::string& object, const std::string& name) const;

    [[nodiscard]] const std::filesystem::path& path() const { return input_.path(); }
    [[nodiscard]] bool has_digest() const { return has_digest_; }

  private:
    [[nodiscard]] Error error(const std::string& name, std::string_view what) const;
    [[nodiscard]] Error attribute_error(const std::string& object, const std::string& name,
                                        std::string_view what) const;
    [[nodiscard]] H5::Group open_group(const std::string& name) const;
    [[nodiscard]] H5::DataSet open(const std::string& name) const;
    [[nodiscard]] H5::DataSet open(const std::string& name, const std::vector<hsize_t>& dimensions) const;
    [[nodiscard]] std::vector<hsize_t> shape_in_file(const std::string& name,
                                                     const H5::DataSet& dataset) const;
    [[nodiscard]] H5::Attribute open_attribute(const std::string& object, const std::string& name) const;
    template <typename Value>
    [[nodiscard]] std::vector<Value> values(const std::string& name, const H5::DataSet& dataset,
                                            const H5::DataSpace& memory, const H5::DataSpace& place) const;
    template <typename Value>
    [[nodiscard]] Value number(const std::string& object, const std::string& name,
                               const H5::PredType& type) const;
    void charge(const std::string& name, const H5::DataSet& dataset) const;

    InputFile input_;
    bool has_digest_;
    H5::H5File file_;
    mutable std::set<std::string> plain_;   ///< paths to which plain links lead
    mutable std::set<std::string> judged_;  ///< datasets whose storage is known to be sound
    mutable hsize_t claimed_ = 0;           ///< bytes: of these datasets together
};

}  // namespace samara
