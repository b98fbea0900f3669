#include "samara/files/hdf5_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include "samara/base/error.hpp"
#include "samara/files/replace_file.hpp"

namespace samara {
namespace {

constexpr hsize_t largest_chunk = 1U << 16U;  // elements

H5::FileAccPropList latest_format() {
    H5::Exception::dontPrint();
    H5::FileAccPropList access;
    access.setLibverBounds(H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    return access;
}

/// Object times off, so that equal content gives equal bytes. The file's own list speaks of its root group.
template <typename CreationList>
CreationList without_times(CreationList list) {
    H5Pset_obj_track_times(list.getId(), 0);
    return list;
}

H5::H5File create(const std::filesystem::path& file) {
    return {file.string(), H5F_ACC_TRUNC, without_times(H5::FileCreatPropList()), latest_format()};
}

H5::Group create_group(const H5::Group& parent, const std::string& name) {
    const H5::PropList creation = without_times(H5::PropList(H5P_GROUP_CREATE));
    const hid_t made = H5Gcreate2(parent.getId(), name.c_str(), H5P_DEFAULT, creation.getId(), H5P_DEFAULT);
    if (made < 0) throw H5::GroupIException("create_group", name);
    H5::Group group(made);
    H5Gclose(made);  // the object holds a reference of its own
    return group;
}

H5::H5File open_for_reading(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) {
        throw Error(fmt::format("{}: there is no such file", file.string()));
    }
    try {
        return {file.string(), H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, latest_format()};
    } catch (const H5::Exception&) {
        throw Error(fmt::format("{}: is not an HDF5 file, or was cut short; make it again", file.string()));
    }
}

H5::StrType string_of(std::size_t length) {
    H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(length, 1));
    type.setCset(H5T_CSET_UTF8);
    type.setStrpad(H5T_STR_NULLPAD);
    return type;
}

void write_text_attribute(H5::H5Object& object, const std::string& name, std::string_view text) {
    const H5::StrType type = string_of(text.size());
    const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
    object.createAttribute(name, type, H5::DataSpace(H5S_SCALAR)).write(type, padded.data());
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file) : path_(file), file_(create(file)) {}

H5::Group Hdf5Writer::group(const std::string& name) {
    H5::Group current = file_.openGroup("/");
    for (std::size_t begin = 1; begin < name.size();) {
        const std::size_t end = std::min(name.find('/', begin), name.size());
        const std::string child = name.substr(begin, end - begin);
        current = current.nameExists(child) ? current.openGroup(child) : create_group(current, child);
        begin = end + 1;
    }
    return current;
}

namespace {

/// The largest chunk of neighbours in a row-major array.
std::vector<hsize_t> usual_chunk(const std::vector<hsize_t>& dimensions) {
    std::vector<hsize_t> chunk = dimensions;
    hsize_t left = largest_chunk;
    for (std::size_t i = chunk.size(); i-- > 0;) {
        chunk[i] = std::clamp<hsize_t>(left, 1, std::max<hsize_t>(dimensions[i], 1));
        left /= chunk[i];
    }
    return chunk;
}

/// The part of a dataset's space at `offset`.
H5::DataSpace part_of(const H5::DataSet& dataset, const std::vector<hsize_t>& offset,
                      const std::vector<hsize_t>& shape) {
    H5::DataSpace space = dataset.getSpace();
    space.selectHyperslab(H5S_SELECT_SET, shape.data(), offset.data());
    return space;
}

}  // namespace

H5::DataSet Hdf5Writer::dataset(const std::string& name, const H5::DataType& type,
                                const std::vector<hsize_t>& dimensions, const std::vector<hsize_t>& chunk,
                                std::string_view units, std::string_view meaning) {
    const std::size_t slash = name.rfind('/');
    H5::Group parent = group(name.substr(0, slash));
    H5::DSetCreatPropList creation = without_times(H5::DSetCreatPropList());
    const bool empty = std::find(dimensions.begin(), dimensions.end(), 0U) != dimensions.end();
    if (!empty) {
        creation.setChunk(static_cast<int>(chunk.size()), chunk.data());
        creation.setFletcher32();
    }
    const H5::DataSpace space(static_cast<int>(dimensions.size()), dimensions.data());
    H5::DataSet result = parent.createDataSet(name.substr(slash + 1), type, space, creation);
    write_text_attribute(result, "units", units);
    write_text_attribute(result, "description", meaning);
    return result;
}

void Hdf5Writer::write(const std::string& name, const std::vector<double>& values,
                       const std::vector<hsize_t>& dimensions, std::string_view units,
                       std::string_view meaning) {
    H5::DataSet target =
        dataset(name, H5::PredType::IEEE_F64LE, dimensions, usual_chunk(dimensions), units, meaning);
    if (!values.empty()) {
        write_values(target, values.data(), H5::PredType::NATIVE_DOUBLE, H5::DataSpace::ALL,
                     H5::DataSpace::ALL);
    }
}

void Hdf5Writer::write(const std::string& name, const std::vector<std::int32_t>& values,
                       const std::vector<hsize_t>& dimensions, std::string_view units,
                       std::string_view meaning) {
    H5::DataSet target =
        dataset(name, H5::PredType::STD_I32LE, dimensions, usual_chunk(dimensions), units, meaning);
    if (!values.empty()) {
        write_values(target, values.data(), H5::PredType::NATIVE_INT32, H5::DataSpace::ALL,
                     H5::DataSpace::ALL);
    }
}

void Hdf5Writer::reserve(const std::string& name, const std::vector<hsize_t>& dimensions,
                         const std::vector<hsize_t>& chunk, std::string_view units,
                         std::string_view meaning) {
    dataset(name, H5::PredType::IEEE_F64LE, dimensions, chunk, units, meaning);
}

void Hdf5Writer::write_block(const std::string& name, const std::vector<double>& values,
                             const std::vector<hsize_t>& offset, const std::vector<hsize_t>& shape) {
    const H5::DataSet target = file_.openDataSet(name);
    const H5::DataSpace memory(static_cast<int>(shape.size()), shape.data());
    write_values(target, values.data(), H5::PredType::NATIVE_DOUBLE, memory, part_of(target, offset, shape));
}

void Hdf5Writer::write_values(const H5::DataSet& dataset, const void* values, const H5::DataType& type,
                              const H5::DataSpace& memory, const H5::DataSpace& place) {
    try {
        dataset.write(values, type, memory, place);
        // Small datasets wait in memory until they are closed, where a failure could not be told.
        if (H5Dflush(dataset.getId()) < 0) throw H5::DataSetIException("write", "H5Dflush failed");
    } catch (const H5::Exception&) {
        // Before the dataset is closed: HDF5 cannot close what it cannot write, and crashes when the program
        // ends.
        abandon();
        throw;
    }
}

void Hdf5Writer::shorten(const std::string& name, const std::vector<hsize_t>& dimensions) {
    file_.openDataSet(name).extend(dimensions.data());
}

void Hdf5Writer::write_text(const std::string& name, std::string_view text, std::string_view meaning) {
    H5::DataSet target =
        dataset(name, H5::PredType::STD_U8LE, {text.size()}, usual_chunk({text.size()}), "1", meaning);
    if (!text.empty()) {
        write_values(target, text.data(), H5::PredType::NATIVE_UINT8, H5::DataSpace::ALL, H5::DataSpace::ALL);
    }
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::string_view text) {
    H5::Group owner = group(object);
    write_text_attribute(owner, name, text);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, double value) {
    group(object)
        .createAttribute(name, H5::PredType::IEEE_F64LE, H5::DataSpace(H5S_SCALAR))
        .write(H5::PredType::NATIVE_DOUBLE, &value);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::int64_t value) {
    group(object)
        .createAttribute(name, H5::PredType::STD_I64LE, H5::DataSpace(H5S_SCALAR))
        .write(H5::PredType::NATIVE_INT64, &value);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::uint64_t value) {
    group(object)
        .createAttribute(name, H5::PredType::STD_U64LE, H5::DataSpace(H5S_SCALAR))
        .write(H5::PredType::NATIVE_UINT64, &value);
}

void Hdf5Writer::flush() {
    file_.flush(H5F_SCOPE_GLOBAL);
}

int Hdf5Writer::descriptor() const {
    void* handle = nullptr;
    const bool known = H5Fget_vfd_handle(file_.getId(), H5P_DEFAULT, &handle) >= 0;
    return known ? *static_cast<const int*>(handle) : -1;
}

void Hdf5Writer::expect_size(std::uintmax_t bytes) {
    rlimit limit = {};
    const bool allowed = ::getrlimit(RLIMIT_FSIZE, &limit) != 0 || bytes <= limit.rlim_cur;
    if (!allowed) errno = EFBIG;
    if (allowed && ::fallocate(descriptor(), FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(bytes)) == 0) {
        has_room_ = true;
    } else if (errno == ENOSPC || errno == EFBIG || errno == EDQUOT) {
        const int reason = errno;
        abandon();
        throw Error(fmt::format("there is no room for its {:.3g} GB: {}", static_cast<double>(bytes) / 1e9,
                                std::strerror(reason)));
    }
}

void Hdf5Writer::abandon() noexcept {
    const int nowhere = ::memfd_create("abandoned", MFD_CLOEXEC);
    if (nowhere < 0) return;
    ::dup2(nowhere, descriptor());
    ::close(nowhere);
}

Hdf5Writer::~Hdf5Writer() {
    try {
        file_.close();
        // Room beyond the file's end goes back to the disk.
        if (has_room_) std::filesystem::resize_file(path_, std::filesystem::file_size(path_));
    } catch (...) {  // the file was abandoned
    }
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) : path_(file), file_(open_for_reading(file)) {}

bool Hdf5Reader::has(const std::string& name) const {
    try {
        for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
            if (!file_.nameExists(name.substr(0, end))) return false;
            if (end == std::string::npos) return true;
        }
    } catch (const H5::Exception&) {
        throw Error(fmt::format("{}: is damaged at {}; make the file again", path_.string(), name));
    }
}

H5::DataSet Hdf5Reader::open(const std::string& name, const std::vector<hsize_t>& dimensions) const {
    const auto fault = [&](std::string_view what) {
        return Error(fmt::format("{}: {} {}; the file is of another kind or was changed: make it again",
                                 path_.string(), name, what));
    };
    try {
        H5::DataSet dataset = file_.openDataSet(name);
        const H5::DataSpace space = dataset.getSpace();
        std::vector<hsize_t> found(static_cast<std::size_t>(space.getSimpleExtentNdims()));
        space.getSimpleExtentDims(found.data());
        const bool fits = found.size() == dimensions.size() &&
                          std::equal(found.begin(), found.end(), dimensions.begin(),
                                     [](hsize_t is, hsize_t wanted) { return wanted == 0 || is == wanted; });
        if (!fits) throw fault(fmt::format("has the shape {}, not {} (0: any)", found, dimensions));
        return dataset;
    } catch (const H5::Exception&) {
        throw fault("is missing");
    }
}

namespace {

template <typename Value>
std::vector<Value> read_all(const H5::DataSet& dataset, const H5::PredType& type, H5T_class_t kind,
                            const std::filesystem::path& path, const std::string& name) {
    try {
        if (dataset.getTypeClass() != kind) {
            throw Error(
                fmt::format("{}: {} holds values of another type; make the file again", path.string(), name));
        }
        std::vector<Value> values(static_cast<std::size_t>(dataset.getSpace().getSimpleExtentNpoints()));
        if (!values.empty()) dataset.read(values.data(), type);
        return values;
    } catch (const H5::Exception&) {
        throw Error(
            fmt::format("{}: {} is damaged (its checksum is wrong or it was cut short); make the file again",
                        path.string(), name));
    }
}

}  // namespace

std::vector<double> Hdf5Reader::doubles(const std::string& name,
                                        const std::vector<hsize_t>& dimensions) const {
    return read_all<double>(open(name, dimensions), H5::PredType::NATIVE_DOUBLE, H5T_FLOAT, path_, name);
}

namespace {

void require_finite(const std::vector<double>& values, const std::filesystem::path& path,
                    const std::string& name) {
    if (std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) return;
    throw Error(
        fmt::format("{}: {} holds a value that is not finite; make the file again", path.string(), name));
}

}  // namespace

std::vector<double> Hdf5Reader::finite_doubles(const std::string& name,
                                               const std::vector<hsize_t>& dimensions) const {
    std::vector<double> values = doubles(name, dimensions);
    require_finite(values, path_, name);
    return values;
}

std::vector<double> Hdf5Reader::finite_block(const std::string& name, const std::vector<hsize_t>& offset,
                                             const std::vector<hsize_t>& shape) const {
    const H5::DataSet dataset = open(name, std::vector<hsize_t>(shape.size(), 0));
    const H5::DataSpace memory(static_cast<int>(shape.size()), shape.data());
    std::vector<double> values(static_cast<std::size_t>(memory.getSimpleExtentNpoints()));
    try {
        dataset.read(values.data(), H5::PredType::NATIVE_DOUBLE, memory, part_of(dataset, offset, shape));
    } catch (const H5::Exception&) {
        throw Error(
            fmt::format("{}: {} is damaged (its checksum is wrong or it was cut short); make the file again",
                        path_.string(), name));
    }
    require_finite(values, path_, name);
    return values;
}

std::vector<std::int32_t> Hdf5Reader::integers(const std::string& name,
                                               const std::vector<hsize_t>& dimensions) const {
    return read_all<std::int32_t>(open(name, dimensions), H5::PredType::NATIVE_INT32, H5T_INTEGER, path_,
                                  name);
}

std::string Hdf5Reader::text(const std::string& name) const {
    const std::vector<char> bytes =
        read_all<char>(open(name, {0}), H5::PredType::NATIVE_UINT8, H5T_INTEGER, path_, name);
    return {bytes.begin(), bytes.end()};
}

std::vector<hsize_t> Hdf5Reader::shape(const std::string& name) const {
    try {
        const H5::DataSpace space = file_.openDataSet(name).getSpace();
        std::vector<hsize_t> dimensions(static_cast<std::size_t>(space.getSimpleExtentNdims()));
        space.getSimpleExtentDims(dimensions.data());
        return dimensions;
    } catch (const H5::Exception&) {
        throw Error(fmt::format("{}: {} is missing; make the file again", path_.string(), name));
    }
}

void Hdf5Reader::require_shape(const std::string& name, const std::vector<hsize_t>& dimensions) const {
    (void)open(name, dimensions);
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
    try {
        return file_.openGroup(object).attrExists(name);
    } catch (const H5::Exception&) {
        throw Error(fmt::format("{}: {} is missing; make the file again", path_.string(), object));
    }
}

std::vector<std::string> Hdf5Reader::children(const std::string& group) const {
    try {
        const H5::Group parent = file_.openGroup(group);
        std::vector<std::string> names;
        for (hsize_t i = 0; i < parent.getNumObjs(); ++i) names.push_back(parent.getObjnameByIdx(i));
        std::sort(names.begin(), names.end());
        return names;
    } catch (const H5::Exception&) {
        throw Error(fmt::format("{}: {} is missing; make the file again", path_.string(), group));
    }
}

H5::Attribute Hdf5Reader::open_attribute(const std::string& object, const std::string& name) const {
    try {
        return file_.openGroup(object).openAttribute(name);
    } catch (const H5::Exception&) {
        throw Error(fmt::format("{}: the attribute {} of {} is missing; make the file again", path_.string(),
                                name, object));
    }
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
    const H5::Attribute attribute = open_attribute(object, name);
    try {
        std::string text(attribute.getStorageSize(), '\0');
        attribute.read(string_of(text.size()), text.data());
        text.resize(std::min(text.size(), text.find('\0')));
        return text;
    } catch (const H5::Exception&) {
        throw Error(fmt::format("{}: the attribute {} of {} is no text; make the file again", path_.string(),
                                name, object));
    }
}

double Hdf5Reader::number_attribute(const std::string& object, const std::string& name) const {
    const H5::Attribute attribute = open_attribute(object, name);
    try {
        double value = 0.0;
        attribute.read(H5::PredType::NATIVE_DOUBLE, &value);
        return value;
    } catch (const H5::Exception&) {
        throw Error(fmt::format("{}: the attribute {} of {} is no number; make the file again",
                                path_.string(), name, object));
    }
}

namespace {

template <typename Integer>
Integer read_integer(const H5::Attribute& attribute, const H5::PredType& type,
                     const std::filesystem::path& path, const std::string& object, const std::string& name) {
    try {
        if (attribute.getTypeClass() == H5T_INTEGER) {
            Integer value = 0;
            attribute.read(type, &value);
            return value;
        }
    } catch (const H5::Exception&) {  // the same fault for the user
    }
    throw Error(fmt::format("{}: the attribute {} of {} is no integer; make the file again", path.string(),
                            name, object));
}

}  // namespace

std::int64_t Hdf5Reader::integer_attribute(const std::string& object, const std::string& name) const {
    return read_integer<std::int64_t>(open_attribute(object, name), H5::PredType::NATIVE_INT64, path_, object,
                                      name);
}

std::uint64_t Hdf5Reader::unsigned_attribute(const std::string& object, const std::string& name) const {
    return read_integer<std::uint64_t>(open_attribute(object, name), H5::PredType::NATIVE_UINT64, path_,
                                       object, name);
}

void write_hdf5(const std::filesystem::path& file, const std::function<void(Hdf5Writer&)>& fill) {
    replace_file(file, [&](const std::filesystem::path& temporary) {
        try {
            Hdf5Writer writer(temporary);
            try {
                fill(writer);
                writer.flush();
            } catch (...) {
                writer.abandon();
                throw;
            }
        } catch (const H5::Exception& failure) {
            throw Error(
                fmt::format("{}: cannot be written ({}); is the folder writable and the disk not full?",
                            file.string(), failure.getDetailMsg()));
        }
    });
}

std::vector<double> flattened(const std::vector<Vector3d>& vectors) {
    std::vector<double> values;
    values.reserve(3 * vectors.size());
    for (const Vector3d& vector : vectors) values.insert(values.end(), vector.data(), vector.data() + 3);
    return values;
}

std::vector<Vector3d> unflattened(const std::vector<double>& values) {
    std::vector<Vector3d> vectors(values.size() / 3);
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = Vector3d(values.data() + 3 * i);
    return vectors;
}

}  // namespace samara
