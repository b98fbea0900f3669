#include "internal/files/hdf5_checks.hpp"

#include <algorithm>

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

/// The bytes that whole chunks of the dataset take, each with its checksum where it has one.
std::optional<hsize_t> bytes_of_chunks(const H5::DSetCreatPropList& creation,
                                       const std::vector<hsize_t>& shape, std::size_t value_bytes) {
    std::vector<hsize_t> chunk(shape.size());
    const int rank = creation.getChunk(static_cast<int>(chunk.size()), chunk.data());
    if (rank != static_cast<int>(shape.size())) return std::nullopt;
    std::vector<hsize_t> chunks(shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i) {
        if (chunk[i] == 0) return std::nullopt;
        chunks[i] = shape[i] / chunk[i] + (shape[i] % chunk[i] != 0 ? 1 : 0);
    }
    const std::optional<hsize_t> count = value_count(chunks);
    const std::optional<hsize_t> plain = bytes_of(chunk, value_bytes);
    if (!count || !plain) return std::nullopt;
    return product(*count, *plain + checksum_bytes * static_cast<hsize_t>(creation.getNfilters()));
}

/// A filter that is no checksum.
bool is_encoded(const H5::DSetCreatPropList& creation) {
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
    const H5S_class_t kind = space.getSimpleExtentType();
    if (kind == H5S_SCALAR) return std::vector<hsize_t>{};
    if (kind != H5S_SIMPLE) return std::nullopt;
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
    if (layout == H5D_VIRTUAL || creation.getExternalCount() > 0) return {"is kept in other files"};
    if (is_encoded(creation)) return {"is compressed or encoded"};
    const H5::DataType type = dataset.getDataType();
    if (!is_real(type) && !is_integer(type)) return {"holds values of another type"};
    const auto shape = shape_of(dataset.getSpace());
    if (!shape) return {"holds nothing"};
    const std::optional<hsize_t> wanted = bytes_of(*shape, type.getSize());
    if (!wanted) return {"claims more values than can be counted"};
    if (*wanted == 0) return {};
    const hsize_t stored = dataset.getStorageSize();
    const bool fits = layout == H5D_CHUNKED ? bytes_of_chunks(creation, *shape, type.getSize()) == stored
                                            : *wanted <= stored;
    if (!fits) return {"claims values that are not stored"};
    return {{}, stored};
}

std::string fault_of_number(const H5::Attribute& attribute, bool integer) {
    const H5::DataType type = attribute.getDataType();
    if (!is_integer(type) && (integer || !is_real(type))) return integer ? "is no integer" : "is no number";
    return holds_one_value(attribute) ? "" : "is not one value";
}

std::string fault_of_text(const H5::Attribute& attribute, std::uint64_t most_bytes) {
    const H5::DataType type = attribute.getDataType();
    if (type.getClass() != H5T_STRING || type.isVariableStr()) return "is no text of fixed length";
    if (!holds_one_value(attribute)) return "is not one value";
    return type.getSize() <= most_bytes ? "" : "is longer than the file";
}

}  // namespace samara
