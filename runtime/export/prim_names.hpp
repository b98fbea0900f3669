#pragma once

#include <cctype>
#include <set>
#include <string>

#include <fmt/format.h>

namespace samara {

/// Names of prims: letters, digits and underscores, each name once.
class PrimNames {
  public:
    std::string operator()(const std::string& name) {
        std::string prim = name;
        for (char& letter : prim) {
            if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
        }
        if (prim.empty() || std::isdigit(static_cast<unsigned char>(prim.front())) != 0) prim = "_" + prim;
        std::string unused = prim;
        for (int i = 1; !used_.insert(unused).second; ++i) unused = fmt::format("{}_{}", prim, i);
        return unused;
    }

  private:
    std::set<std::string> used_;
};

}  // namespace samara
