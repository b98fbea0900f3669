#include "samara/core/files/hdf5_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_checks.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/replace_file.hpp"

namespace samara {
namespace {

constexpr hsize_t largest_chunk = 1U << 16U;  // elements

H5::FileAccPropList latest_format() {
    H5::Exception::dontPrint();
    H5::FileAccPropList access;
    access.setLibverBounds(H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    return access;
}

/// Switches object times off, so that equal content gives equal bytes. The list of the file itself sets those
/// of its root group.
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

/// Returns the largest chunk of neighbours in a row-major array.
std::vector<hsize_t> usual_chunk(const std::vector<hsize_t>& dimensions) {
    std::vector<hsize_t> chunk = dimensions;
    hsize_t left = largest_chunk;
    for (std::size_t i = chunk.size(); i-- > 0;) {
        chunk[i] = std::clamp<hsize_t>(left, 1, std::max<hsize_t>(dimensions[i], 1));
        left /= chunk[i];
    }
    return chunk;
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
    write_values(target, values.data(), H5::PredType::NATIVE_DOUBLE, memory,
                 selected_block(target, offset, shape));
}

void Hdf5Writer::write_values(const H5::DataSet& dataset, const void* values, const H5::DataType& type,
                              const H5::DataSpace& memory, const H5::DataSpace& place) {
    try {
        dataset.write(values, type, memory, place);
        // Small datasets stay in memory until they are closed, where a failure could not be reported.
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
        throw Error(fmt::format("there is no space for its {:.3g} GB: {}", static_cast<double>(bytes) / 1e9,
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
        // Reserved room beyond the file's end is given back.
        if (has_room_) std::filesystem::resize_file(path_, std::filesystem::file_size(path_));
    } catch (...) {  // the file was abandoned
    }
}

void write_hdf5(const std::filesystem::path& file, const std::function<void(Hdf5Writer&)>& fill) {
    replace_file_by_name(file, [&](const std::filesystem::path& temporary) {
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
            throw Error(fmt::format(
                "{}: cannot be written ({}); check the folder's permissions and the free disk space",
                file.string(), failure.getDetailMsg()));
        }
        append_digest(temporary);
        Hdf5Reader::trust(temporary);
    });
}

}  // namespace samara
