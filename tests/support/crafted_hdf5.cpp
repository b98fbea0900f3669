#include "support/crafted_hdf5.hpp"

#include <algorithm>
#include <cstddef>

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
