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

/// An error behind the C interface: an Error with the status that the caller gets.
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

/// Copies a text that may hold names from files as copy_text() does, made printable(); an empty one where
/// memory lacks.
void copy_printable(std::string_view text, char* buffer, std::size_t size) noexcept;

/// Throws StatusError of SAMARA_INVALID_ARGUMENT where the pointer is null.
void require(const void* pointer, const char* name);

/// Returns the lock of HDF5, which is often built without its own. All objects share it.
std::mutex& hdf5_mutex();

/// Returns the status for an error of a simulation.
samara_status status_of(SimulationError::Reason reason) noexcept;

/// Runs the body of a C function and returns its status: no exception leaves, and the caller's buffer gets
/// its text (empty where there is none). An Error that is no StatusError gives `otherwise`.
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
