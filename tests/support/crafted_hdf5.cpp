#include "support/crafted_hdf5.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace samara::test {
namespace {

H5::H5File open(const std::filesystem::path& file) {
    return {file.string(), H5F_ACC_RDWR};
}

void remove(const H5::H5File& file, const std::string& name) {
    if (file.nameExists(name)) file.unlink(name);
}

}  // namespace

void put_attribute(const std::filesystem::path& file, const std::string& object, const std::string& name,
                   const H5::DataType& type, hsize_t count) {
    const H5::H5File opened = open(file);
    H5::Group group = opened.openGroup(object);
    if (group.attrExists(name)) group.removeAttr(name);
    const H5::DataSpace space = count > 0 ? H5::DataSpace(1, &count) : H5::DataSpace(H5S_NULL);
    const H5::Attribute attribute = group.createAttribute(name, type, space);
    const std::vector<std::byte> zeros(std::max<hsize_t>(count, 1) * type.getSize());
    if (count > 0) attribute.write(type, zeros.data());
}

void put_dataset(const std::filesystem::path& file, const std::string& name, const H5::DataType& type,
                 const std::vector<hsize_t>& shape, const H5::DSetCreatPropList& creation) {
    H5::H5File opened = open(file);
    remove(opened, name);
    opened.createDataSet(name, type, H5::DataSpace(static_cast<int>(shape.size()), shape.data()), creation);
}

H5::DSetCreatPropList in_chunks(const std::vector<hsize_t>& chunk) {
    H5::DSetCreatPropList creation;
    creation.setChunk(static_cast<int>(chunk.size()), chunk.data());
    return creation;
}

void make_hdf5(const std::filesystem::path& file, const std::vector<hsize_t>& shape, bool in_latest_format) {
    H5::FileAccPropList access;
    if (in_latest_format) access.setLibverBounds(H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    H5::H5File made(file.string(), H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, access);
    const H5::DataSpace space(static_cast<int>(shape.size()), shape.data());
    std::vector<double> values(static_cast<std::size_t>(space.getSimpleExtentNpoints()));
    std::iota(values.begin(), values.end(), 1.0);
    made.createDataSet("/values", H5::PredType::IEEE_F64LE, space)
        .write(values.data(), H5::PredType::NATIVE_DOUBLE);
}

bool put_in_chunks(const std::filesystem::path& file, const std::string& name, const ChunkLayout& layout,
                   const std::vector<CraftedChunk>& crafted) {
    H5::H5File opened = open(file);
    std::vector<double> values;
    std::vector<hsize_t> shape;
    {
        const H5::DataSet old = opened.openDataSet(name);
        shape.resize(static_cast<std::size_t>(old.getSpace().getSimpleExtentNdims()));
        old.getSpace().getSimpleExtentDims(shape.data());
        values.resize(static_cast<std::size_t>(old.getSpace().getSimpleExtentNpoints()));
        old.read(values.data(), H5::PredType::NATIVE_DOUBLE);
    }
    std::vector<hsize_t> most = shape;
    std::fill_n(most.begin(), std::min(layout.growing, most.size()), H5S_UNLIMITED);
    H5::DSetCreatPropList creation = in_chunks(layout.chunk);
    if (layout.has_checksum) creation.setFletcher32();
    opened.unlink(name);
    const H5::DataSet dataset = opened.createDataSet(
        name, H5::PredType::IEEE_F64LE,
        H5::DataSpace(static_cast<int>(shape.size()), shape.data(), most.data()), creation);
    dataset.write(values.data(), H5::PredType::NATIVE_DOUBLE);
    return std::all_of(crafted.begin(), crafted.end(), [&](const CraftedChunk& chunk) {
        const std::vector<std::byte> zeros(chunk.bytes);
        return H5Dwrite_chunk(dataset.getId(), H5P_DEFAULT, chunk.mask, chunk.place.data(), chunk.bytes,
                              zeros.data()) >= 0;
    });
}

void put_text(const std::filesystem::path& file, const std::string& name, const std::string& text) {
    const H5::H5File opened = open(file);
    remove(opened, name);
    const hsize_t size = text.size();
    opened.createDataSet(name, H5::PredType::STD_U8LE, H5::DataSpace(1, &size))
        .write(text.data(), H5::PredType::NATIVE_UINT8);
}

H5::DSetCreatPropList in_other_file(const std::filesystem::path& other, hsize_t bytes) {
    H5::DSetCreatPropList creation;
    creation.setExternal(other.c_str(), 0, bytes);
    return creation;
}

H5::DSetCreatPropList in_dataset_of(const std::filesystem::path& other, const std::string& name,
                                    const std::vector<hsize_t>& shape) {
    H5::DSetCreatPropList creation;
    const H5::DataSpace space(static_cast<int>(shape.size()), shape.data());
    H5Pset_virtual(creation.getId(), space.getId(), other.c_str(), name.c_str(), space.getId());
    return creation;
}

void put_link(const std::filesystem::path& file, const std::string& place, const std::string& name,
              const std::filesystem::path& other) {
    const H5::H5File opened = open(file);
    remove(opened, place);
    if (other.empty()) {
        H5Lcreate_soft(name.c_str(), opened.getId(), place.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    } else {
        H5Lcreate_external(other.c_str(), name.c_str(), opened.getId(), place.c_str(), H5P_DEFAULT,
                           H5P_DEFAULT);
    }
}

}  // namespace samara::test
