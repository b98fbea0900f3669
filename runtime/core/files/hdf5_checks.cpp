#include "samara/core/files/hdf5_checks.hpp"

#include <algorithm>
#include <limits>

namespace samara {
namespace {

constexpr hsize_t checksum_bytes = 4;  // fletcher32, behind each chunk

std::optional<hsize_t> product(hsize_t a, hsize_t b) {
    hsize_t result = 0;
    if (__builtin_mul_overflow(a, b, &result)) return std::nullopt;
    return result;
}

std::optional<hsize_t> bytes_of(const std::vector<hsize_t>& shape, std::size_t value_bytes) {
    const std::optional<hsize_t> count = value_count(shape);
    return count ? product(*count, value_bytes) : std::nullopt;
}

bool is_one_of(const H5::DataType& type, std::initializer_list<hid_t> known) {
    return std::any_of(known.begin(), known.end(),
                       [&](hid_t one) { return H5Tequal(type.getId(), one) > 0; });
}

bool holds_one_value(const H5::Attribute& attribute) {
    const auto shape = shape_of(attribute.getSpace());
    return shape && value_count(*shape) == hsize_t{1};
}

/// The chunks that a dataset of a given shape is stored in.
struct Chunks {
    std::vector<hsize_t> shape;   ///< of one chunk
    std::vector<hsize_t> counts;  ///< along each axis
    hsize_t count = 0;
    hsize_t bytes = 0;  ///< of one chunk in the file, with its checksum where it has one
};

/// Returns the chunks; nothing where they do not fit the shape, or are more or larger than HDF5 can have
/// them.
std::optional<Chunks> chunks_of(const H5::DSetCreatPropList& creation, const std::vector<hsize_t>& shape,
                                std::size_t value_bytes) {
    constexpr hsize_t most_bytes = std::numeric_limits<std::uint32_t>::max();
    Chunks chunks;
    chunks.shape.resize(shape.size());
    const int rank = creation.getChunk(static_cast<int>(shape.size()), chunks.shape.data());
    if (rank != static_cast<int>(shape.size())) return std::nullopt;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        const hsize_t length = chunks.shape[i];
        if (length == 0) return std::nullopt;
        chunks.counts.push_back(shape[i] / length + (shape[i] % length != 0 ? 1 : 0));
    }
    const std::optional<hsize_t> count = value_count(chunks.counts);
    const std::optional<hsize_t> bytes = bytes_of(chunks.shape, value_bytes);
    if (!count || !bytes || *bytes > most_bytes) return std::nullopt;
    chunks.count = *count;
    chunks.bytes = *bytes + checksum_bytes * static_cast<hsize_t>(creation.getNfilters());
    return chunks;
}

/// Returns the bytes of all of the dataset's chunks.
std::optional<hsize_t> bytes_of_chunks(const H5::DSetCreatPropList& creation,
                                       const std::vector<hsize_t>& shape, std::size_t value_bytes) {
    const std::optional<Chunks> chunks = chunks_of(creation, shape, value_bytes);
    return chunks ? product(chunks->count, chunks->bytes) : std::nullopt;
}

/// Returns whether the values pass a filter that is no checksum, or chunks at the edge pass none.
bool is_encoded(const H5::DSetCreatPropList& creation) {
    unsigned options = 0;
    if (creation.getLayout() == H5D_CHUNKED && H5Pget_chunk_opts(creation.getId(), &options) >= 0 &&
        options != 0) {
        return true;
    }
    const int filters = creation.getNfilters();
    for (int i = 0; i < filters; ++i) {
        unsigned flags = 0;
        std::size_t values = 0;
        unsigned config = 0;
        if (H5Pget_filter2(creation.getId(), static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr,
                           &config) != H5Z_FILTER_FLETCHER32) {
            return true;
        }
    }
    return filters > 1;
}

}  // namespace

std::optional<hsize_t> value_count(const std::vector<hsize_t>& shape) {
    std::optional<hsize_t> count = 1;
    for (const hsize_t length : shape) {
        if (count) count = product(*count, length);
    }
    return count;
}

std::optional<std::vector<hsize_t>> shape_of(const H5::DataSpace& space) {
    const H5S_class_t type = space.getSimpleExtentType();
    if (type == H5S_SCALAR) return std::vector<hsize_t>{};
    if (type != H5S_SIMPLE) return std::nullopt;
    std::vector<hsize_t> shape(static_cast<std::size_t>(space.getSimpleExtentNdims()));
    space.getSimpleExtentDims(shape.data());
    return shape;
}

bool is_real(const H5::DataType& type) {
    return is_one_of(type, {H5T_IEEE_F64LE, H5T_IEEE_F64BE, H5T_IEEE_F32LE, H5T_IEEE_F32BE});
}

bool is_integer(const H5::DataType& type) {
    return is_one_of(type,
                     {H5T_STD_I8LE, H5T_STD_I8BE, H5T_STD_I16LE, H5T_STD_I16BE, H5T_STD_I32LE, H5T_STD_I32BE,
                      H5T_STD_I64LE, H5T_STD_I64BE, H5T_STD_U8LE, H5T_STD_U8BE, H5T_STD_U16LE, H5T_STD_U16BE,
                      H5T_STD_U32LE, H5T_STD_U32BE, H5T_STD_U64LE, H5T_STD_U64BE});
}

StorageClaim storage_claim(const H5::DataSet& dataset) {
    const H5::DSetCreatPropList creation = dataset.getCreatePlist();
    const H5D_layout_t layout = creation.getLayout();
    if (layout == H5D_VIRTUAL || creation.getExternalCount() > 0) return {"is stored in other files"};
    if (is_encoded(creation)) return {"is compressed or encoded"};
    const H5::DataType type = dataset.getDataType();
    if (!is_real(type) && !is_integer(type)) return {"holds values of another type"};
    const auto shape = shape_of(dataset.getSpace());
    if (!shape) return {"holds nothing"};
    const std::optional<hsize_t> wanted = bytes_of(*shape, type.getSize());
    if (!wanted) return {"declares too many values"};
    if (*wanted == 0) return {};
    const hsize_t stored = dataset.getStorageSize();
    const bool fits = layout == H5D_CHUNKED ? bytes_of_chunks(creation, *shape, type.getSize()) == stored
                                            : *wanted <= stored;
    if (!fits) return {"declares values that are not stored"};
    return {{}, stored};
}

std::string error_of_chunks(const H5::DataSet& dataset) {
    const std::string other_size = "has a chunk whose size does not match its values";
    const H5::DSetCreatPropList creation = dataset.getCreatePlist();
    if (creation.getLayout() != H5D_CHUNKED) return {};
    const std::vector<hsize_t> shape = shape_of(dataset.getSpace()).value();
    const std::optional<Chunks> chunks = chunks_of(creation, shape, dataset.getDataType().getSize());
    if (!chunks) return other_size;
    const bool has_checksum = creation.getNfilters() > 0;
    std::vector<char> stored(has_checksum ? static_cast<std::size_t>(chunks->bytes) : 0);
    std::vector<hsize_t> place(shape.size(), 0);  // of the chunk's first value
    for (hsize_t i = 0; i < chunks->count; ++i) {
        hsize_t bytes = 0;
        if (H5Dget_chunk_storage_size(dataset.getId(), place.data(), &bytes) < 0 || bytes != chunks->bytes) {
            return other_size;
        }
        // This call alone takes a time that does not grow with the number of chunks.
        std::uint32_t passed_over = 0;
        if (has_checksum &&
            (H5Dread_chunk(dataset.getId(), H5P_DEFAULT, place.data(), &passed_over, stored.data()) < 0 ||
             passed_over != 0)) {
            return "has a chunk without its checksum";
        }
        for (std::size_t axis = shape.size(); axis-- > 0;) {
            place[axis] += chunks->shape[axis];
            if (place[axis] < shape[axis]) break;
            place[axis] = 0;
        }
    }
    return {};
}

std::string error_of_number(const H5::Attribute& attribute, bool integer) {
    const H5::DataType type = attribute.getDataType();
    if (!is_integer(type) && (integer || !is_real(type)))
        return integer ? "is not an integer" : "is not a number";
    return holds_one_value(attribute) ? "" : "is not a single value";
}

std::string error_of_text(const H5::Attribute& attribute, std::uint64_t most_bytes) {
    const H5::DataType type = attribute.getDataType();
    if (type.getClass() != H5T_STRING || type.isVariableStr()) return "is not a string of fixed length";
    if (!holds_one_value(attribute)) return "is not a single value";
    return type.getSize() <= most_bytes ? "" : "is longer than the file";
}

H5::DataSpace selected_block(const H5::DataSet& dataset, const std::vector<hsize_t>& offset,
                             const std::vector<hsize_t>& shape) {
    H5::DataSpace space = dataset.getSpace();
    space.selectHyperslab(H5S_SELECT_SET, shape.data(), offset.data());
    return space;
}

}  // namespace samara
