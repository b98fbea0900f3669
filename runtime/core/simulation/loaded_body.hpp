#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "samara/core/body/body.hpp"

namespace samara {

class PreparedBodies;

/// A body with the content hash of its file. Copies share its content and the bodies prepared from it: many
/// take the time and memory of one. May be used by several threads.
struct LoadedBody {
    /// Takes a body in memory, with the content hash of its file.
    LoadedBody(std::shared_ptr<const Body> held, std::string hash_of_file);
    /// Takes a body in memory; `hash_of_file` is empty where it comes from no file.
    LoadedBody(Body held, std::string hash_of_file);

    std::shared_ptr<const Body> body;          ///< never null
    std::string hash;                          ///< of its file, in hexadecimal digits
    std::shared_ptr<PreparedBodies> prepared;  ///< core/dynamics/immersed_body.hpp
};

/// Reads a body file. Throws Error as read_body_file() does (body_file.hpp).
LoadedBody load_body_file(const std::filesystem::path& file);

}  // namespace samara
