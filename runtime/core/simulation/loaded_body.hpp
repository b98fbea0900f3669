#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "samara/core/body/body.hpp"

namespace samara {

class PreparedBodies;

/// A body with the content hash of its file. Copies share what it holds, and what was made of it for the
/// steps: a crowd of them takes the time and memory of one. May be used by several threads.
struct LoadedBody {
    /// A body that is held already, with the digest of its file.
    LoadedBody(std::shared_ptr<const Body> held, std::string hash_of_file);
    /// `hash_of_file`: empty where the body is of no file.
    LoadedBody(Body held, std::string hash_of_file);

    std::shared_ptr<const Body> body;          ///< never null
    std::string hash;                          ///< of its file, in hexadecimal digits
    std::shared_ptr<PreparedBodies> prepared;  ///< core/dynamics/prepared_bodies.hpp
};

/// The body of a body file. Throws Error as read_body_file() does (body_file.hpp).
LoadedBody load_body_file(const std::filesystem::path& file);

}  // namespace samara
