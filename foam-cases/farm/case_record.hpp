#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace samara {

/// The JSON object that a script of a case left behind (failed.json, mesh.json, ...); an empty one where the
/// file is missing or damaged.
nlohmann::json read_record(const std::filesystem::path& file);

/// The text of that name in a record; empty where it has none.
std::string text_in(const nlohmann::json& record, const char* name);

/// The number of that name in a record; 0 where it has none.
double number_in(const nlohmann::json& record, const char* name);

}  // namespace samara
