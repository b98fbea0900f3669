#include "samara/core/simulation/loaded_body.hpp"

#include <utility>

#include "samara/core/body/body_file.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {

LoadedBody::LoadedBody(std::shared_ptr<const Body> held, std::string hash_of_file)
    : body(std::move(held)), hash(std::move(hash_of_file)), prepared(std::make_shared<PreparedBodies>()) {}

LoadedBody::LoadedBody(Body held, std::string hash_of_file)
    : LoadedBody(std::make_shared<const Body>(std::move(held)), std::move(hash_of_file)) {}

LoadedBody load_body_file(const std::filesystem::path& file) {
    return {read_body_file(file), file_content_hash(file)};
}

}  // namespace samara
