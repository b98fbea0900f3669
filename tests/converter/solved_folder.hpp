#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "samara/core/body/body.hpp"
#include "support/temporary_folder.hpp"

namespace samara::test {

/// A box of the given edges (m), closed, with its moments and the symmetry of three mirrors.
Body box_body(const Vector3d& edges);

/// Writes a folder of solved cases as `samara bake` and OpenFOAM leave it: a near wake of three cells of
/// unequal volume, 20 iterations of which the last 11 are averaged, and loads that follow a law, in case
/// axes.
class SolvedFolder {
  public:
    using Law = std::function<LoadEntry(const Vector3d& direction, double reynolds_number)>;

    SolvedFolder(Body body, int subdivisions, const std::vector<double>& reynolds_numbers, const Law& law);

    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
    [[nodiscard]] const Body& body() const { return body_; }
    /// The cases' names, in the plan's order.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] std::filesystem::path case_path(std::size_t index) const { return path() / names_[index]; }
    /// Rewrites a file of the folder.
    void write(const std::filesystem::path& name, std::string_view text) const {
        static_cast<void>(folder_.file(name, text));
    }
    /// Rewrites plan.json as modified by `change`.
    void change_plan(const std::function<void(nlohmann::json&)>& change) const;
    /// A file of the folder with the first `from` in it made `to`.
    void replace(const std::filesystem::path& name, const std::string& from, const std::string& to) const;

  private:
    void write_case(const std::string& name, const Vector3d& direction, double reynolds_number,
                    const LoadEntry& entry) const;

    TemporaryFolder folder_;
    Body body_;
    std::vector<std::string> names_;
};

}  // namespace samara::test
