// Feeds files to a harness one after another: what the fuzzers found, and the seeds that they began from,
// without libFuzzer.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "harness.hpp"
#include "samara/core/files/content_hash.hpp"

int main(int count, char** arguments) {
    std::vector<std::filesystem::path> files;
    for (int i = 1; i < count; ++i) {
        for (const auto& entry : std::filesystem::directory_iterator(arguments[i])) files.push_back(entry);
    }
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) {
        std::printf("%s\n", file.filename().c_str());
        std::fflush(stdout);  // so that the last name is that of the file that ends the program
        samara::fuzz::feed(samara::read_bytes(file));
    }
    std::printf("%zu files\n", files.size());
    return files.empty() ? 1 : 0;
}
