#pragma once

#include <cstddef>
#include <mutex>
#include <new>
#include <string>
#include <string_view>

#include "samara.h"
#include "samara/core/base/error.hpp"
#include "samara/core/simulation/simulation.hpp"

namespace samara {

/// What goes wrong behind the C interface: an Error with the status that the caller gets.
class StatusError : public Error {
  public:
    StatusError(samara_status status, const std::string& message) : Error(message), status_(status) {}
    [[nodiscard]] samara_status status() const noexcept { return status_; }

  private:
    samara_status status_;
};

/// Copies the text into a caller's buffer (null or of size 0: nowhere), cut where it is too long, but not
/// within a character.
void copy_text(std::string_view text, char* buffer, std::size_t size) noexcept;

/// The same for a text that may hold names from files, as printable() shows it; nothing where memory lacks.
void copy_printable(std::string_view text, char* buffer, std::size_t size) noexcept;

/// Throws Fault of SAMARA_INVALID_ARGUMENT where the pointer is null.
void require(const void* pointer, const char* name);

/// HDF5 is often built without its own lock. The one thing that all objects share.
std::mutex& hdf5_mutex();

/// What the caller gets for a fault of a flight.
samara_status status_of(SimulationError::Reason reason) noexcept;

/// Runs the body of a C function: nothing that it throws leaves, and the caller's buffer gets its text (empty
/// where all went well). An Error that is no Fault gives `otherwise`.
template <typename Work>
samara_status guarded(char* error, std::size_t error_size, const Work& work,
                      samara_status otherwise = SAMARA_INVALID_ARGUMENT) noexcept {
    copy_text("", error, error_size);
    try {
        work();
        return SAMARA_OK;
    } catch (const StatusError& caught) {
        copy_printable(caught.what(), error, error_size);
        return caught.status();
    } catch (const SimulationError& caught) {
        copy_printable(caught.what(), error, error_size);
        return status_of(caught.reason());
    } catch (const Error& caught) {
        copy_printable(caught.what(), error, error_size);
        return otherwise;
    } catch (const std::bad_alloc&) {
        copy_text("there is not enough memory", error, error_size);
        return SAMARA_OUT_OF_MEMORY;
    } catch (const std::exception& caught) {
        copy_printable(caught.what(), error, error_size);
        return SAMARA_INTERNAL_ERROR;
    } catch (...) {
        copy_text("an unknown error", error, error_size);
        return SAMARA_INTERNAL_ERROR;
    }
}

}  // namespace samara
