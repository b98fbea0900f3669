#include "samara/core/files/hdf5_reader.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_checks.hpp"
#include "samara/core/files/input_file.hpp"

namespace samara {
namespace {

/// The check that files must pass before this process reads them, and the files that have passed.
struct Door {
    std::mutex mutex;
    void (*check)(const InputFile&) = nullptr;
    std::set<FileState> known;
};

Door& door() {
    static Door door;
    return door;
}

const std::filesystem::path& checked(const std::filesystem::path& path) {
    if (door().check == nullptr) return path;
    const InputFile file(path);
    const std::lock_guard lock(door().mutex);
    const FileState state = state_of(file);
    if (door().known.contains(state)) return path;
    door().check(file);
    door().known.insert(state);
    return path;
}

H5::H5File open_for_reading(const InputFile& input) {
    H5::Exception::dontPrint();
    try {
        // Without a cache of chunks HDF5 reads values without checksums from their place in the file,
        // whatever chunk size the file claims.
        H5::FileAccPropList access;
        access.setCache(0, 0, 0, 0.0);
        return {input.name(), H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, access};
    } catch (const H5::Exception&) {
        throw Error(
            fmt::format("{}: is not an HDF5 file, or is truncated; make it again", input.path().string()));
    }
}

constexpr const char* damaged = "is damaged (its checksum is wrong or it is truncated)";

}  // namespace

void Hdf5Reader::set_check(void (*check)(const InputFile& file)) {
    door().check = check;
}

void Hdf5Reader::trust(const std::filesystem::path& path) {
    const InputFile file(path);
    const std::lock_guard lock(door().mutex);
    door().known.insert(state_of(file));
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file)
    : input_(checked(file)), has_digest_(verify_digest(input_)), file_(open_for_reading(input_)) {
    haddr_t end = 0;
    if (!has_digest_ && (H5Fget_eoa(file_.getId(), &end) < 0 || end < input_.size())) {
        throw Error(
            fmt::format("{}: is damaged (it has bytes after its content); make it again", path().string()));
    }
}

Error Hdf5Reader::error(const std::string& name, std::string_view what) const {
    return Error(fmt::format("{}: {} {}; make the file again", path().string(), name, what));
}

Error Hdf5Reader::attribute_error(const std::string& object, const std::string& name,
                                  std::string_view what) const {
    return error(fmt::format("the attribute {} of {}", name, object), what);
}

bool Hdf5Reader::has(const std::string& name) const {
    if (name == "/") return true;
    try {
        for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
            const std::string step = name.substr(0, end);
            if (!plain_.contains(step)) {
                if (!file_.nameExists(step)) return false;
                H5L_info_t link = {};
                if (H5Lget_info(file_.getId(), step.c_str(), &link, H5P_DEFAULT) < 0)
                    throw error(step, damaged);
                // Other links may lead anywhere, such as to other files.
                if (link.type != H5L_TYPE_HARD)
                    throw error(step, "is an external link, which is not followed");
                plain_.insert(step);
            }
            if (end == std::string::npos) return true;
        }
    } catch (const H5::Exception&) {
        throw error(name, damaged);
    }
}

H5::Group Hdf5Reader::open_group(const std::string& name) const {
    if (!has(name)) throw error(name, "is missing");
    try {
        return file_.openGroup(name);
    } catch (const H5::Exception&) {
        throw error(name, "is not a group");
    }
}

void Hdf5Reader::charge(const std::string& name, const H5::DataSet& dataset) const {
    if (judged_.contains(name)) return;
    const StorageClaim claim = storage_claim(dataset);
    if (!claim.error.empty()) throw error(name, claim.error);
    if (claim.bytes > input_.size() - claimed_) throw error(name, "declares more bytes than the file has");
    const std::string wrong = claim.bytes > 0 ? error_of_chunks(dataset) : "";
    if (!wrong.empty()) throw error(name, wrong);
    claimed_ += claim.bytes;
    judged_.insert(name);
}

H5::DataSet Hdf5Reader::open(const std::string& name) const {
    if (!has(name)) throw error(name, "is missing");
    try {
        H5::DataSet dataset = file_.openDataSet(name);
        charge(name, dataset);
        return dataset;
    } catch (const H5::Exception&) {
        throw error(name, "is not a dataset, or is damaged");
    }
}

H5::DataSet Hdf5Reader::open(const std::string& name, const std::vector<hsize_t>& dimensions) const {
    H5::DataSet dataset = open(name);
    const std::vector<hsize_t> found = shape_in_file(name, dataset);
    const bool fits = found.size() == dimensions.size() &&
                      std::equal(found.begin(), found.end(), dimensions.begin(),
                                 [](hsize_t is, hsize_t wanted) { return wanted == 0 || is == wanted; });
    if (!fits) {
        throw error(name,
                    fmt::format("has the shape {}, not {} (0: any): the file has another type or was changed",
                                found, dimensions));
    }
    return dataset;
}

std::vector<hsize_t> Hdf5Reader::shape_in_file(const std::string& name, const H5::DataSet& dataset) const {
    try {
        return shape_of(dataset.getSpace()).value();
    } catch (const H5::Exception&) {
        throw error(name, damaged);
    }
}

std::vector<hsize_t> Hdf5Reader::shape(const std::string& name) const {
    return shape_in_file(name, open(name));
}

void Hdf5Reader::require_shape(const std::string& name, const std::vector<hsize_t>& dimensions) const {
    (void)open(name, dimensions);
}

template <typename Value>
std::vector<Value> Hdf5Reader::values(const std::string& name, const H5::DataSet& dataset,
                                      const H5::DataSpace& memory, const H5::DataSpace& place) const {
    constexpr bool real = std::is_floating_point_v<Value>;
    try {
        const H5::DataType type = dataset.getDataType();
        if (real ? !is_real(type) : !is_integer(type)) throw error(name, "holds values of another type");
        std::vector<Value> values(static_cast<std::size_t>(memory.getSelectNpoints()));
        if (values.empty()) return values;
        if constexpr (real) {
            dataset.read(values.data(), H5::PredType::NATIVE_DOUBLE, memory, place);
            const bool finite =
                std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
            if (!finite) throw error(name, "holds a value that is not finite");
        } else {
            const bool bytes = sizeof(Value) == 1;
            dataset.read(values.data(), bytes ? H5::PredType::NATIVE_UINT8 : H5::PredType::NATIVE_INT32,
                         memory, place);
        }
        return values;
    } catch (const H5::Exception&) {
        throw error(name, damaged);
    }
}

std::vector<double> Hdf5Reader::finite_doubles(const std::string& name,
                                               const std::vector<hsize_t>& dimensions) const {
    const H5::DataSet dataset = open(name, dimensions);
    return values<double>(name, dataset, dataset.getSpace(), dataset.getSpace());
}

std::vector<double> Hdf5Reader::finite_block(const std::string& name, const std::vector<hsize_t>& offset,
                                             const std::vector<hsize_t>& shape) const {
    const H5::DataSet dataset = open(name, std::vector<hsize_t>(shape.size(), 0));
    const H5::DataSpace memory(static_cast<int>(shape.size()), shape.data());
    return values<double>(name, dataset, memory, selected_block(dataset, offset, shape));
}

std::vector<std::int32_t> Hdf5Reader::integers(const std::string& name,
                                               const std::vector<hsize_t>& dimensions) const {
    const H5::DataSet dataset = open(name, dimensions);
    return values<std::int32_t>(name, dataset, dataset.getSpace(), dataset.getSpace());
}

std::string Hdf5Reader::text(const std::string& name) const {
    const H5::DataSet dataset = open(name, {0});
    const std::vector<char> bytes = values<char>(name, dataset, dataset.getSpace(), dataset.getSpace());
    return {bytes.begin(), bytes.end()};
}

std::string Hdf5Reader::json_text(const std::string& name) const {
    std::string bytes = text(name);
    if (const std::string wrong = error_of_json_size(bytes); !wrong.empty()) throw error(name, wrong);
    return bytes;
}

std::vector<std::string> Hdf5Reader::children(const std::string& group) const {
    const H5::Group parent = open_group(group);
    std::vector<std::string> names;
    const auto take = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return 0;
    };
    if (H5Literate(parent.getId(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, take, &names) < 0) {
        throw error(group, damaged);
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
    const H5::Group group = open_group(object);
    try {
        return group.attrExists(name);
    } catch (const H5::Exception&) {
        throw error(object, damaged);
    }
}

H5::Attribute Hdf5Reader::open_attribute(const std::string& object, const std::string& name) const {
    const H5::Group group = open_group(object);
    try {
        return group.openAttribute(name);
    } catch (const H5::Exception&) {
        throw attribute_error(object, name, "is missing");
    }
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
    const H5::Attribute attribute = open_attribute(object, name);
    try {
        const std::string wrong = error_of_text(attribute, input_.size());
        if (!wrong.empty()) throw attribute_error(object, name, wrong);
        const H5::DataType type = attribute.getDataType();
        std::string text(type.getSize(), '\0');
        attribute.read(type, text.data());
        text.resize(std::min(text.size(), text.find('\0')));
        return text;
    } catch (const H5::Exception&) {
        throw attribute_error(object, name, "is not a string");
    }
}

template <typename Value>
Value Hdf5Reader::number(const std::string& object, const std::string& name, const H5::PredType& type) const {
    const H5::Attribute attribute = open_attribute(object, name);
    try {
        const std::string wrong = error_of_number(attribute, std::is_integral_v<Value>);
        if (!wrong.empty()) throw attribute_error(object, name, wrong);
        Value value = 0;
        attribute.read(type, &value);
        return value;
    } catch (const H5::Exception&) {
        throw attribute_error(object, name, damaged);
    }
}

double Hdf5Reader::number_attribute(const std::string& object, const std::string& name) const {
    return number<double>(object, name, H5::PredType::NATIVE_DOUBLE);
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& object, const std::string& name) const {
    return number<std::int64_t>(object, name, H5::PredType::NATIVE_INT64);
}

std::uint64_t Hdf5Reader::unsigned_attribute(const std::string& object, const std::string& name) const {
    return number<std::uint64_t>(object, name, H5::PredType::NATIVE_UINT64);
}

}  // namespace samara
