#include "foam-cases/farm/case_record.hpp"

#include "samara/core/files/content_hash.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {

nlohmann::json read_record(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file)) return nlohmann::json::object();
    nlohmann::json record = parse_json_or_discard(read_bytes(file));
    return record.is_object() ? record : nlohmann::json::object();
}

std::string text_in(const nlohmann::json& record, const char* name) {
    const auto found = record.find(name);
    return found != record.end() && found->is_string() ? found->get<std::string>() : std::string();
}

double number_in(const nlohmann::json& record, const char* name) {
    const auto found = record.find(name);
    return found != record.end() && found->is_number() ? found->get<double>() : 0.0;
}

}  // namespace samara
