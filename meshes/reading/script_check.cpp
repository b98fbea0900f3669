#include <algorithm>
#include <cctype>
#include <initializer_list>

#include <fmt/format.h>

#include "meshes/reading/shape_reader.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

bool is_letter(char character) {
    return std::isalpha(static_cast<unsigned char>(character)) != 0 || character == '_';
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// A word, a quoted text (represented by its first quote), a sign, or an empty text at the end.
struct Token {
    std::string_view text;
    int line = 0;

    [[nodiscard]] bool is_word() const { return !text.empty() && is_letter(text.front()); }
    [[nodiscard]] bool is_text() const { return text == "\"" || text == "'"; }
};

// Splits a script into the tokens of gmsh's Gmsh.l, as far as statements are distinguished by them.
class Tokens {
  public:
    explicit Tokens(std::string_view script) : rest_(script) {}

    Token next() {
        skip_blanks_and_comments();
        Token token{rest_.substr(0, 1), line_};
        if (rest_.empty()) return token;
        if (token.is_text()) {
            drop(std::min(rest_.find(rest_.front(), 1), rest_.size() - 1) + 1);
            return token;
        }
        if (token.is_word()) token.text = rest_.substr(0, length_of_word());
        drop(token.text.size());
        return token;
    }

  private:
    [[nodiscard]] std::size_t length_of_word() const {
        const auto* const end = std::find_if_not(rest_.begin(), rest_.end(), [](char c) {
            return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
        });
        return static_cast<std::size_t>(end - rest_.begin());
    }

    void skip_blanks_and_comments() {
        while (!rest_.empty()) {
            if (rest_.starts_with("//")) {
                drop(std::min(rest_.find('\n'), rest_.size()));
            } else if (rest_.starts_with("/*")) {
                drop(std::min(rest_.find("*/", 2), rest_.size() - 2) + 2);
            } else if (std::isspace(static_cast<unsigned char>(rest_.front())) != 0) {
                drop(1);
            } else {
                return;
            }
        }
    }

    void drop(std::size_t count) {
        line_ += static_cast<int>(
            std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
        rest_.remove_prefix(count);
    }

    std::string_view rest_;
    int line_ = 1;
};

[[noreturn]] void reject(const std::string& label, const Token& token, std::string_view what) {
    throw Error(fmt::format("{}: line {}: {} {}, which is not allowed in a shape; delete the statement",
                            label, token.line, token.text, what));
}

std::string_view rejected_commands(std::string_view word) {
    if (is_one_of(word, {"SystemCall", "NonBlockingSystemCall", "System"})) return "starts a program";
    if (is_one_of(word, {"Save", "Print", "CreateDir"})) return "writes a file";
    if (word == "SendToServer") return "sends data away";
    return {};
}

}  // namespace

void require_shape_script(std::string_view script, const std::string& label) {
    Tokens tokens(script);
    Token before;
    int depth_of_printf = -1;  // depth of parentheses inside a Printf; -1: outside
    Token printf_token;
    for (Token token = tokens.next(); !token.text.empty();) {
        const Token after = tokens.next();
        if (token.text == "Exit") reject(label, token, "ends gmsh");
        if (token.text == "OnelabRun") reject(label, token, "starts a program");
        // The names of commands are no keywords: variables and macros may have them too.
        const bool is_name = is_one_of(before.text, {"For", "Macro", "Function", "Call"});
        if (!is_name && (after.is_text() || after.is_word())) {
            const std::string_view what = rejected_commands(token.text);
            if (!what.empty()) reject(label, token, what);
        }
        if (before.text == "=" && token.text == "ExternalProcess") reject(label, token, "starts a program");
        if (token.text == "Printf") {
            printf_token = token;
            depth_of_printf = 0;
        } else if (depth_of_printf >= 0) {
            if (token.text == "(") ++depth_of_printf;
            if (token.text == ")") --depth_of_printf;
            if (depth_of_printf == 0 && token.text == ">") reject(label, printf_token, "writes a file");
            if (depth_of_printf == 0 && token.text == ";") depth_of_printf = -1;
        }
        before = token;
        token = after;
    }
}

}  // namespace samara
