#include "hdf5_recipe.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <tuple>

#include <fmt/format.h>
#include <hdf5.h>

#include "samara/core/files/content_hash.hpp"

namespace samara::fuzz {
namespace {

constexpr hsize_t most_written = 100'000;  // values; more are claimed, but take no room
constexpr std::size_t most_lines = 16;

/// An identifier of HDF5's, closed at the end; below zero where HDF5 refused.
class Handle {
  public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    [[nodiscard]] hid_t get() const { return id_; }
    [[nodiscard]] bool is_open() const { return id_ >= 0; }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

struct Place {
    std::string object;
    std::string attribute;  ///< empty: the object itself

    explicit Place(const std::string& name)
        : object(name.substr(0, name.find('@'))),
          attribute(name.find('@') == std::string::npos ? "" : name.substr(name.find('@') + 1)) {}
};

/// A dataset or an attribute.
struct Item {
    std::string type = "f64";
    std::vector<hsize_t> shape;  ///< empty: a scalar
    std::vector<double> numbers = {0.0};
    std::string text = "text";
};

struct PlainType {
    const char* name;
    H5T_class_t kind;
    std::size_t bytes;
    bool is_signed;
    hid_t id;
};

const std::array<PlainType, 8>& plain_types() {
    static const std::array<PlainType, 8> types = {{{"f64", H5T_FLOAT, 8, true, H5T_IEEE_F64LE},
                                                    {"f32", H5T_FLOAT, 4, true, H5T_IEEE_F32LE},
                                                    {"i8", H5T_INTEGER, 1, true, H5T_STD_I8LE},
                                                    {"u8", H5T_INTEGER, 1, false, H5T_STD_U8LE},
                                                    {"i32", H5T_INTEGER, 4, true, H5T_STD_I32LE},
                                                    {"u32", H5T_INTEGER, 4, false, H5T_STD_U32LE},
                                                    {"i64", H5T_INTEGER, 8, true, H5T_STD_I64LE},
                                                    {"u64", H5T_INTEGER, 8, false, H5T_STD_U64LE}}};
    return types;
}

hid_t string_type(std::size_t length) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, length);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

/// The type of that name, as it stands in the file.
hid_t stored_type(const Item& item) {
    for (const PlainType& plain : plain_types()) {
        if (item.type == plain.name) return H5Tcopy(plain.id);
    }
    if (item.type == "text") return string_type(std::max<std::size_t>(item.text.size(), 1));
    if (item.type == "vtext") return string_type(H5T_VARIABLE);
    if (item.type == "array") {
        const hsize_t length = 64;
        return H5Tarray_create2(H5T_IEEE_F64LE, 1, &length);
    }
    if (item.type == "compound") {
        const hid_t type = H5Tcreate(H5T_COMPOUND, 24);
        for (std::size_t i = 0; i < 3; ++i) {
            H5Tinsert(type, std::string(1, "xyz"[i]).c_str(), 8 * i, H5T_IEEE_F64LE);
        }
        return type;
    }
    return H5Tcreate(H5T_OPAQUE, 40);
}

std::string name_of_type(hid_t type) {
    const H5T_class_t kind = H5Tget_class(type);
    if (kind == H5T_STRING) return H5Tis_variable_str(type) > 0 ? "vtext" : "text";
    for (const PlainType& plain : plain_types()) {
        const bool sign_fits = kind != H5T_INTEGER || plain.is_signed == (H5Tget_sign(type) == H5T_SGN_2);
        if (kind == plain.kind && H5Tget_size(type) == plain.bytes && sign_fits) return plain.name;
    }
    return "opaque";
}

/// Reads the item at the place; what is no dataset or attribute of numbers or text gives the default.
Item read_item(hid_t file, const Place& place) {
    Item item;
    const bool in_attribute = !place.attribute.empty();
    const Handle object = in_attribute
                              ? Handle(H5Aopen_by_name(file, place.object.c_str(), place.attribute.c_str(),
                                                       H5P_DEFAULT, H5P_DEFAULT),
                                       H5Aclose)
                              : Handle(H5Dopen2(file, place.object.c_str(), H5P_DEFAULT), H5Dclose);
    if (!object.is_open()) return item;
    const Handle space(in_attribute ? H5Aget_space(object.get()) : H5Dget_space(object.get()), H5Sclose);
    const Handle type(in_attribute ? H5Aget_type(object.get()) : H5Dget_type(object.get()), H5Tclose);
    item.type = name_of_type(type.get());
    const int rank = H5Sget_simple_extent_ndims(space.get());
    const hssize_t count = H5Sget_simple_extent_npoints(space.get());
    if (rank < 0 || count < 1 || count > static_cast<hssize_t>(most_written)) return item;
    item.shape.resize(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), item.shape.data(), nullptr);
    const auto read = [&](hid_t as, void* values) {
        in_attribute ? H5Aread(object.get(), as, values)
                     : H5Dread(object.get(), as, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    };
    if (item.type == "text" && count == 1) {
        item.text.assign(H5Tget_size(type.get()), '\0');
        read(type.get(), item.text.data());
    } else if (item.type != "text" && item.type != "vtext" && item.type != "opaque") {
        item.numbers.assign(static_cast<std::size_t>(count), 0.0);
        read(H5T_NATIVE_DOUBLE, item.numbers.data());
    }
    return item;
}

void remove(hid_t file, const Place& place) {
    if (place.attribute.empty()) {
        H5Ldelete(file, place.object.c_str(), H5P_DEFAULT);
    } else {
        H5Adelete_by_name(file, place.object.c_str(), place.attribute.c_str(), H5P_DEFAULT);
    }
}

/// The values as HDF5 takes them to write `count` of the type.
class Values {
  public:
    Values(const Item& item, hid_t stored, hsize_t count) : type_(stored) {
        const bool plain = std::any_of(plain_types().begin(), plain_types().end(),
                                       [&](const PlainType& one) { return item.type == one.name; });
        if (plain) {
            type_ = H5T_NATIVE_DOUBLE;
            for (hsize_t i = 0; i < count; ++i) numbers_.push_back(item.numbers[i % item.numbers.size()]);
        } else if (item.type == "vtext") {
            texts_.assign(count, item.text.c_str());
        } else {
            bytes_.assign(H5Tget_size(stored) * count, '\x3f');
            if (item.type == "text") std::copy(item.text.begin(), item.text.end(), bytes_.begin());
        }
    }
    [[nodiscard]] hid_t type() const { return type_; }
    [[nodiscard]] const void* data() const {
        if (!numbers_.empty()) return numbers_.data();
        return texts_.empty() ? static_cast<const void*>(bytes_.data()) : texts_.data();
    }

  private:
    hid_t type_;
    std::vector<double> numbers_;
    std::vector<const char*> texts_;
    std::string bytes_;
};

/// Puts the item in the place of what was there.
void write_item(hid_t file, const Place& place, const Item& item) {
    remove(file, place);
    const bool in_attribute = !place.attribute.empty();
    const Handle type(stored_type(item), H5Tclose);
    const Handle space(item.shape.empty() ? H5Screate(H5S_SCALAR)
                                          : H5Screate_simple(static_cast<int>(item.shape.size()),
                                                             item.shape.data(), nullptr),
                       H5Sclose);
    if (!space.is_open()) return;
    double count = 1.0;
    for (const hsize_t length : item.shape) count *= static_cast<double>(length);
    const bool is_claim = count > static_cast<double>(most_written);
    if (is_claim && in_attribute) return;  // which takes its room at once
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (is_claim) {
        const std::vector<hsize_t> chunk(item.shape.size(), 1);
        H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
    }
    const Handle object =
        in_attribute
            ? Handle(H5Acreate_by_name(file, place.object.c_str(), place.attribute.c_str(), type.get(),
                                       space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose)
            : Handle(H5Dcreate2(file, place.object.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                creation.get(), H5P_DEFAULT),
                     H5Dclose);
    if (!object.is_open() || is_claim || count == 0.0) return;
    const Values values(item, type.get(), static_cast<hsize_t>(count));
    in_attribute ? H5Awrite(object.get(), values.type(), values.data())
                 : H5Dwrite(object.get(), values.type(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

/// Stores the first of two chunks as `bytes` zeros, and the second so that both together are as long as whole
/// ones.
void spoil_chunks(hid_t dataset, const std::vector<hsize_t>& shape, std::size_t axis, hsize_t rows,
                  hsize_t whole, hsize_t bytes, std::uint32_t mask) {
    if (bytes == 0 || bytes > most_written) return;
    std::vector<hsize_t> place(shape.size(), 0);
    const std::string zeros(std::max(bytes, 2 * whole), '\0');
    H5Dwrite_chunk(dataset, H5P_DEFAULT, mask, place.data(), bytes, zeros.data());
    place[axis] = rows;
    if (rows >= shape[axis] || bytes >= 2 * whole) return;
    H5Dwrite_chunk(dataset, H5P_DEFAULT, 1, place.data(), 2 * whole - bytes, zeros.data());
}

/// Stores a dataset of plain numbers anew in chunks.
void rechunk(hid_t file, const Place& place, const Item& item, std::istringstream& words) {
    constexpr hsize_t checksum_bytes = 4;
    std::string kind;
    hsize_t rows = 0;
    hsize_t bytes = 0;
    std::uint32_t mask = 0;
    words >> kind >> rows >> bytes >> mask;
    hsize_t count = 1;
    for (const hsize_t length : item.shape) count *= length;
    if (!place.attribute.empty() || item.shape.empty() || item.numbers.size() != count) return;
    const auto longest = std::max_element(item.shape.begin(), item.shape.end());
    const auto axis = static_cast<std::size_t>(longest - item.shape.begin());
    std::vector<hsize_t> chunk = item.shape;
    chunk[axis] = std::clamp<hsize_t>(rows, 1, *longest);
    std::vector<hsize_t> most = item.shape;
    if (kind == "growing") most[axis] = H5S_UNLIMITED;
    const Handle type(stored_type(item), H5Tclose);
    const Handle space(H5Screate_simple(static_cast<int>(chunk.size()), item.shape.data(), most.data()),
                       H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
    if (kind == "deflated") H5Pset_deflate(creation.get(), 1);
    if (kind == "edges") H5Pset_chunk_opts(creation.get(), H5D_CHUNK_DONT_FILTER_PARTIAL_CHUNKS);
    if (kind != "plain") H5Pset_fletcher32(creation.get());
    remove(file, place);
    const Handle dataset(H5Dcreate2(file, place.object.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                    creation.get(), H5P_DEFAULT),
                         H5Dclose);
    if (!dataset.is_open()) return;
    H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, item.numbers.data());
    const hsize_t whole = count / *longest * chunk[axis] * H5Tget_size(type.get()) + checksum_bytes;
    spoil_chunks(dataset.get(), item.shape, axis, chunk[axis], whole, bytes, mask);
}

double number_of(const std::string& word) {
    return std::strtod(word.c_str(), nullptr);
}

void rename(hid_t file, const Place& place, const Place& to) {
    if (place.attribute.empty()) {
        H5Lmove(file, place.object.c_str(), file, to.object.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    } else {
        H5Arename_by_name(file, place.object.c_str(), place.attribute.c_str(), to.attribute.c_str(),
                          H5P_DEFAULT);
    }
}

/// Edits of the values at a place.
void edit_item(hid_t file, const std::string& verb, const Place& place, std::istringstream& words) {
    Item item = read_item(file, place);
    std::string word;
    if (verb == "type" && words >> word) {
        item.type = word;
    } else if (verb == "shape") {
        item.shape.clear();
        while (words >> word && item.shape.size() < 8) {
            item.shape.push_back(std::strtoull(word.c_str(), nullptr, 10));
        }
    } else if (verb == "number" && words >> word) {
        const std::size_t index = std::strtoull(word.c_str(), nullptr, 10) % item.numbers.size();
        words >> word;
        item.numbers[index] = number_of(word);
    } else if (verb == "fill" && words >> word) {
        item.numbers.assign(1, number_of(word));
    } else if (verb == "text") {
        std::getline(words >> std::ws, item.text);
        item.type = item.type == "vtext" ? "vtext" : "text";
    } else {
        return;
    }
    write_item(file, place, item);
}

void apply_line(hid_t file, const std::string& line) {
    std::istringstream words(line);
    std::string verb;
    std::string name;
    std::string other;
    words >> verb >> name;
    const Place place(name);
    if (verb == "delete") {
        remove(file, place);
    } else if (verb == "group") {
        remove(file, place);
        const Handle made(H5Gcreate2(file, place.object.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          H5Gclose);
    } else if (verb == "rename" && words >> other) {
        rename(file, place, Place(other));
    } else if (verb == "link" && words >> other) {
        remove(file, place);
        H5Lcreate_soft(other.c_str(), file, place.object.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    } else if (std::string target; verb == "external" && words >> target >> other) {
        remove(file, place);
        H5Lcreate_external(target.c_str(), other.c_str(), file, place.object.c_str(), H5P_DEFAULT,
                           H5P_DEFAULT);
    } else {
        edit_item(file, verb, place, words);
    }
}

herr_t add_attribute(hid_t /*object*/, const char* name, const H5A_info_t* /*info*/, void* into) {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
}

herr_t add_object(hid_t file, const char* name, const H5O_info_t* /*info*/, void* into) {
    std::string object = "/";
    if (std::string_view(name) != ".") object += name;
    auto& places = *static_cast<std::vector<std::string>*>(into);
    places.push_back(object);
    std::vector<std::string> attributes;
    H5Aiterate_by_name(file, object.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add_attribute, &attributes,
                       H5P_DEFAULT);
    for (const std::string& attribute : attributes) places.push_back(fmt::format("{}@{}", object, attribute));
    return 0;
}

}  // namespace

SeedFile read_seed_file(const std::filesystem::path& file) {
    SeedFile seed{read_bytes(file), {}};
    const Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    H5Ovisit(opened.get(), H5_INDEX_NAME, H5_ITER_INC, add_object, &seed.places);
    return seed;
}

void apply_recipe(std::string_view recipe, const std::filesystem::path& file) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    std::istringstream lines{std::string(recipe)};
    std::string line;
    std::vector<std::string> chunks;  // last, since HDF5 reads past the end of crafted ones
    for (std::size_t i = 0; i < most_lines && std::getline(lines, line); ++i) {
        if (line.find('\0') != std::string::npos) continue;
        if (line.starts_with("chunk ")) {
            chunks.push_back(line);
        } else {
            apply_line(opened.get(), line);
        }
    }
    std::vector<std::tuple<Place, Item, std::istringstream>> crafted;
    for (const std::string& chunk : chunks) {
        std::istringstream words(chunk);
        std::string name;
        words >> name >> name;
        crafted.emplace_back(name, read_item(opened.get(), Place(name)), std::move(words));
    }
    for (auto& [place, item, words] : crafted) rechunk(opened.get(), place, item, words);
}

}  // namespace samara::fuzz
