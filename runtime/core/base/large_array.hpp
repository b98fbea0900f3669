#pragma once

#include <cstddef>
#include <memory>

namespace samara {

/// `count` zeros of a plain number type, for arrays of megabytes and more: aligned to cache lines, taken from
/// the system when they are first written, and in large pages where the system has them, which takes several
/// times less time. Throws std::bad_alloc.
template <typename Number>
class LargeArray {
  public:
    LargeArray() = default;
    explicit LargeArray(std::size_t count);

    [[nodiscard]] Number* data() const { return numbers_.get(); }
    [[nodiscard]] std::size_t bytes() const { return numbers_.get_deleter().bytes; }

  private:
    struct Release {
        std::size_t bytes = 0;
        void operator()(Number* numbers) const;
    };
    std::unique_ptr<Number, Release> numbers_;
};

extern template class LargeArray<float>;
extern template class LargeArray<double>;

}  // namespace samara
