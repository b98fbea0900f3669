#include "foam-cases/bake/bake_schedule.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <set>
#include <string>
#include <utility>

#include "foam-cases/falls/fall_plan.hpp"
#include "foam-cases/farm/case_folder.hpp"

namespace samara {
namespace {

/// Collects the tasks of a plan, by their names.
class TaskList {
  public:
    explicit TaskList(std::set<std::string> done) : done_(std::move(done)) {}

    void add(const std::string& name, double seconds, const std::vector<std::string>& after) {
        FarmTask task{done_.contains(name) ? 0.0 : seconds, {}};
        for (const std::string& earlier : after) {
            if (const auto found = places_.find(earlier); found != places_.end())
                task.after.push_back(found->second);
        }
        places_[name] = work.tasks.size();
        work.tasks.push_back(std::move(task));
    }
    void add_case(const std::string& name, double seconds, const std::vector<std::string>& after) {
        if (done_.contains(name)) ++work.done;
        add(name, seconds, after);
    }

    FarmWork work;

  private:
    std::set<std::string> done_;
    std::map<std::string, std::size_t> places_;
};

}  // namespace

void FarmWork::add(const FarmWork& other) {
    const std::size_t first = tasks.size();
    for (FarmTask task : other.tasks) {
        for (std::size_t& earlier : task.after) earlier += first;
        tasks.push_back(std::move(task));
    }
    done += other.done;
}

FarmWork farm_work(const std::filesystem::path& folder, const Body& body, const BakePlan& plan,
                   const std::filesystem::path& foam_cases) {
    TaskList list(made_folders(folder, body, plan, foam_cases));
    const std::vector<FlowMesh> meshes = plan.all_meshes();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        list.add(meshes[i].name, estimated_mesh_seconds(plan.cells[i]), {});
    }
    // As in the Snakefile, falls come before cases.
    for (const FreeFall& fall : plan.falls) {
        list.add_case(fall.name, estimated_fall_seconds(fall, cells_of(plan, fall.mesh)), {fall.mesh});
    }
    for (const BakeCase& entry : plan.cases) {
        list.add_case(entry.name, estimated_seconds(plan, entry) / plan.ranks,
                      {entry.mesh, entry.start_from});
    }
    return list.work;
}

double seconds_with(const FarmWork& work, std::size_t slots) {
    const std::size_t count = work.tasks.size();
    std::vector<std::size_t> waits_for(count);
    std::vector<std::vector<std::size_t>> followers(count);
    std::set<std::size_t> ready;  // the order of the list
    for (std::size_t i = 0; i < count; ++i) {
        waits_for[i] = work.tasks[i].after.size();
        for (const std::size_t earlier : work.tasks[i].after) followers[earlier].push_back(i);
        if (waits_for[i] == 0) ready.insert(i);
    }
    using End = std::pair<double, std::size_t>;
    std::priority_queue<End, std::vector<End>, std::greater<>> running;
    double now = 0.0;
    while (!ready.empty() || !running.empty()) {
        while (!ready.empty() && running.size() < slots) {
            const std::size_t next = *ready.begin();
            ready.erase(ready.begin());
            running.emplace(now + work.tasks[next].seconds, next);
        }
        const auto [end, ended] = running.top();
        running.pop();
        now = end;
        for (const std::size_t follower : followers[ended]) {
            if (--waits_for[follower] == 0) ready.insert(follower);
        }
    }
    return now;
}

double longest_chain(const FarmWork& work) {
    // No more tasks than these run at once.
    return seconds_with(work, std::max<std::size_t>(1, work.tasks.size()));
}

}  // namespace samara
