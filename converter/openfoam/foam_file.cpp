#include "converter/openfoam/foam_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>

#include "converter/openfoam/foam_scanner.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

std::string_view without_quotes(std::string_view text) {
    const bool quoted = text.size() >= 2 && text.starts_with('"') && text.ends_with('"');
    return quoted ? text.substr(1, text.size() - 2) : text;
}

/// Reads "LSB;label=32;scalar=64" of a binary file.
void read_architecture(const FoamScanner& scanner, std::string_view words, FoamHeader& header) {
    constexpr const char* other_order = std::endian::native == std::endian::little ? "MSB" : "LSB";
    const auto has = [&](std::string_view word) { return words.find(word) != std::string_view::npos; };
    if (has(other_order)) {
        throw scanner.error(
            "is binary with another byte order; set 'writeFormat ascii' in system/controlDict there and run "
            "foamFormatConvert");
    }
    header.label_bytes = has("label=64") ? 8 : 4;
    header.scalar_bytes = has("scalar=32") ? 4 : 8;
}

/// Passes over an entry's value: up to its semicolon, or a whole dictionary in braces.
void skip_entry(FoamScanner& scanner) {
    if (scanner.accept('{')) {
        scanner.text_before('}');
    } else {
        scanner.text_before(';');
    }
}

/// Reads the header; other entries (arch, note, location, a dictionary meta) differ between versions.
FoamHeader read_header(FoamScanner& scanner) {
    if (scanner.at_end() || scanner.peek() != 'F' || scanner.word() != "FoamFile") {
        throw scanner.error("is not an OpenFOAM file: it does not begin with FoamFile");
    }
    FoamHeader header;
    std::string architecture;
    scanner.expect('{');
    while (!scanner.accept('}')) {
        const std::string key(scanner.word());
        if (scanner.peek() == '{') {
            skip_entry(scanner);
            continue;
        }
        const std::string value(without_quotes(scanner.text_before(';')));
        if (key == "format") header.format = value;
        if (key == "class") header.class_name = value;
        if (key == "object") header.object = value;
        if (key == "arch") architecture = value;
    }
    if (header.format != "ascii" && header.format != "binary") {
        throw scanner.error(
            fmt::format("the format '{}' is neither ascii nor binary; convert the case with "
                        "foamFormatConvert",
                        header.format));
    }
    if (header.format == "binary") read_architecture(scanner, architecture, header);
    return header;
}

template <typename Value>
Value read_value(FoamScanner& scanner) {
    if constexpr (std::is_same_v<Value, double>) {
        return scanner.number();
    } else if constexpr (std::is_same_v<Value, std::int64_t>) {
        return scanner.integer();
    } else {
        scanner.expect('(');
        const double x = scanner.number();
        const double y = scanner.number();
        const double z = scanner.number();
        scanner.expect(')');
        return Vector3d(x, y, z);
    }
}

/// Appends numbers of the type `Stored` as numbers of the type `Number`.
template <typename Stored, typename Number>
void append_stored(std::string_view block, std::vector<Number>& numbers) {
    for (std::size_t at = 0; at < block.size(); at += sizeof(Stored)) {
        Stored stored;
        std::memcpy(&stored, block.data() + at, sizeof stored);
        numbers.push_back(static_cast<Number>(stored));
    }
}

std::vector<double> read_scalars(FoamScanner& scanner, std::size_t count, int bytes) {
    std::vector<double> numbers;
    const std::string_view block = scanner.bytes(count * static_cast<std::size_t>(bytes));
    numbers.reserve(count);
    bytes == 4 ? append_stored<float>(block, numbers) : append_stored<double>(block, numbers);
    return numbers;
}

template <typename Value>
std::vector<Value> read_binary_values(FoamScanner& scanner, const FoamHeader& header, std::size_t count) {
    std::vector<Value> values;
    if constexpr (std::is_same_v<Value, double>) {
        values = read_scalars(scanner, count, header.scalar_bytes);
    } else if constexpr (std::is_same_v<Value, std::int64_t>) {
        const std::string_view block = scanner.bytes(count * static_cast<std::size_t>(header.label_bytes));
        header.label_bytes == 4 ? append_stored<std::int32_t>(block, values)
                                : append_stored<std::int64_t>(block, values);
    } else {
        const std::vector<double> numbers = read_scalars(scanner, 3 * count, header.scalar_bytes);
        for (std::size_t i = 0; i < numbers.size(); i += 3) values.emplace_back(&numbers[i]);
    }
    return values;
}

/// Reads "List<scalar> 3 (1 2 3)", with or without its type, or "3 {1}" for three equal values.
template <typename Value>
std::vector<Value> read_list(FoamScanner& scanner, const FoamHeader& header) {
    if (scanner.peek() == 'L') scanner.word();
    const std::int64_t stated = scanner.integer();
    // A larger count is damage, and must not exhaust the memory.
    if (stated < 0 || stated > (std::int64_t{1} << 33)) {
        throw scanner.error(fmt::format("a list cannot have {} values", stated));
    }
    const auto count = static_cast<std::size_t>(stated);
    if (scanner.accept('{')) {
        // The count is not limited by the size of the file, and must not exhaust the memory.
        constexpr std::size_t most = 32'000'000;
        if (count > most) {
            throw scanner.error(fmt::format("a list in braces may have {} values, not {}", most, count));
        }
        const Value value = read_value<Value>(scanner);
        scanner.expect('}');
        return std::vector<Value>(count, value);
    }
    std::vector<Value> values;
    if (count == 0) {
        if (scanner.accept('(')) scanner.expect(')');
        return values;
    }
    scanner.expect('(');
    if (header.format == "binary") {
        values = read_binary_values<Value>(scanner, header, count);
    } else {
        while (values.size() < count && scanner.peek() != ')') values.push_back(read_value<Value>(scanner));
    }
    if (!scanner.accept(')') || values.size() != count) {
        throw scanner.error(
            fmt::format("the list should have {} values, but {}", count,
                        values.size() < count ? fmt::format("ends after {}", values.size()) : "continues"));
    }
    return values;
}

template <typename Value>
FoamField<Value> read_internal_field(FoamScanner& scanner, const FoamHeader& header) {
    FoamField<Value> field;
    const std::string type(scanner.word());
    if (type == "uniform") {
        field.uniform = true;
        field.values.push_back(read_value<Value>(scanner));
    } else if (type == "nonuniform") {
        field.values = read_list<Value>(scanner, header);
    } else {
        throw scanner.error(fmt::format("expected 'uniform' or 'nonuniform', found '{}'", type));
    }
    scanner.expect(';');
    return field;
}

Error wrong_class(const FoamScanner& scanner, const FoamHeader& header, const std::string& wanted) {
    return scanner.error(fmt::format("holds a {}, not {}",
                                     header.class_name.empty() ? "file without a class" : header.class_name,
                                     wanted));
}

template <typename Value>
FoamField<Value> read_field(const std::filesystem::path& file, const std::string& class_name) {
    FoamScanner scanner(file);
    const FoamHeader header = read_header(scanner);
    // A field on cells only has the class of the field with "::Internal" after it.
    if (header.class_name != class_name && !header.class_name.starts_with(class_name + "::")) {
        throw wrong_class(scanner, header, "a " + class_name);
    }
    while (!scanner.at_end()) {
        const std::string_view key = scanner.word();
        // A field on cells only (::Internal) names its values "value".
        if (key == "internalField" || key == "value") return read_internal_field<Value>(scanner, header);
        if (key.starts_with('#')) {
            scanner.word();  // the file that a directive names
        } else {
            skip_entry(scanner);
        }
    }
    throw scanner.error("has no internalField");
}

/// Reads "2 (4(0 1 2 3) 3(4 5 6))".
FoamFaces read_plain_faces(FoamScanner& scanner, const FoamHeader& header) {
    FoamFaces faces;
    const std::int64_t count = scanner.integer();
    scanner.expect('(');
    faces.starts.push_back(0);
    for (std::int64_t face = 0; face < count; ++face) {
        const std::vector<std::int64_t> points = read_list<std::int64_t>(scanner, header);
        faces.points.insert(faces.points.end(), points.begin(), points.end());
        faces.starts.push_back(static_cast<std::int64_t>(faces.points.size()));
    }
    scanner.expect(')');
    return faces;
}

}  // namespace

FoamField<double> read_scalar_field(const std::filesystem::path& file) {
    return read_field<double>(file, "volScalarField");
}

FoamField<Vector3d> read_vector_field(const std::filesystem::path& file) {
    return read_field<Vector3d>(file, "volVectorField");
}

std::vector<std::int64_t> read_cell_zone(const std::filesystem::path& file, const std::string& name) {
    FoamScanner scanner(file);
    const FoamHeader header = read_header(scanner);
    if (header.class_name != "regIOobject" && header.class_name.find("Zone") == std::string::npos) {
        throw wrong_class(scanner, header, "cell zones");
    }
    std::string others;
    const std::int64_t zones = scanner.integer();
    if (zones > 0) scanner.expect('(');
    for (std::int64_t zone = 0; zone < zones; ++zone) {
        const std::string found(scanner.word());
        std::vector<std::int64_t> cells;
        scanner.expect('{');
        while (!scanner.accept('}')) {
            if (scanner.word() != "cellLabels") {
                skip_entry(scanner);
                continue;
            }
            cells = read_list<std::int64_t>(scanner, header);
            scanner.expect(';');
        }
        if (found == name) return cells;
        others += (others.empty() ? " (it has: " : ", ") + found;
    }
    if (!others.empty()) others += ")";
    throw scanner.error(
        fmt::format("has no cell zone '{}'{}; make it with topoSet (cellZoneSet)", name, others));
}

std::vector<std::int64_t> read_labels(const std::filesystem::path& file) {
    FoamScanner scanner(file);
    const FoamHeader header = read_header(scanner);
    if (header.class_name != "labelList") throw wrong_class(scanner, header, "a labelList");
    return read_list<std::int64_t>(scanner, header);
}

std::vector<Vector3d> read_points(const std::filesystem::path& file) {
    FoamScanner scanner(file);
    const FoamHeader header = read_header(scanner);
    if (header.class_name != "vectorField") throw wrong_class(scanner, header, "a vectorField");
    return read_list<Vector3d>(scanner, header);
}

FoamFaces read_faces(const std::filesystem::path& file) {
    FoamScanner scanner(file);
    const FoamHeader header = read_header(scanner);
    FoamFaces faces;
    if (header.class_name == "faceCompactList") {
        faces.starts = read_list<std::int64_t>(scanner, header);
        faces.points = read_list<std::int64_t>(scanner, header);
    } else if (header.class_name == "faceList" && header.format == "ascii") {
        faces = read_plain_faces(scanner, header);
    } else {
        throw wrong_class(scanner, header, "a faceList in ascii or a faceCompactList");
    }
    const bool ascending = std::is_sorted(faces.starts.begin(), faces.starts.end());
    if (faces.starts.empty() || !ascending || faces.starts.front() != 0 ||
        faces.starts.back() != static_cast<std::int64_t>(faces.points.size())) {
        throw scanner.error("its faces do not fit their points");
    }
    return faces;
}

}  // namespace samara
