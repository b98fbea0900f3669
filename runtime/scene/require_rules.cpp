#include "samara/scene/require_rules.hpp"

namespace samara {

void require_rules(TomlTable& table, const std::optional<BrokenRule>& broken) {
    if (!broken) return;
    const std::size_t dot = broken->member.find('.');
    if (dot == std::string::npos) throw table.error(broken->member, broken->what);
    TomlTable inner = table.table(broken->member.substr(0, dot)).value();
    require_rules(inner, BrokenRule{broken->member.substr(dot + 1), broken->what});
}

}  // namespace samara
