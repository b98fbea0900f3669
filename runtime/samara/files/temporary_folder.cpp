#include "samara/files/temporary_folder.hpp"

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <stdlib.h>

#include "samara/base/error.hpp"

namespace samara {

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "samara-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
        throw Error(
            fmt::format("{}: no temporary folder can be made: {}; set TMPDIR to a folder that can be written",
                        std::filesystem::temp_directory_path().string(), std::strerror(errno)));
    }
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace samara
