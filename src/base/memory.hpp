// How much memory the process may take. What is large is asked for beforehand, so that it is
// refused with what to change; a wall behind all else turns the rest into std::bad_alloc.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lantern {

// Bytes that this process could have: the machine's memory, or less if its control group or its
// own limits (RLIMIT_AS, RLIMIT_DATA) say so.
std::uint64_t machine_memory();

// Bytes; half of machine_memory() unless it was set, which is for the start of a program.
std::uint64_t memory_budget();
void set_memory_budget(std::uint64_t bytes);

// From here on the process gets no more than the budget, beside what it has already: allocations
// beyond it throw std::bad_alloc. Does nothing under the address sanitizer, which maps more than
// there is.
void enforce_memory_budget();

// If the enforced budget keeps `bytes` more from the process, which its own limits would leave it:
// how large a budget would not.
std::optional<std::uint64_t> budget_needed(std::uint64_t bytes);

// Memory that is freed stays with the process, up to some hundred megabytes: a step of many bodies
// takes and frees the same room again and again, and getting it anew costs more than using it. For
// the start of a program.
void keep_freed_memory();

// "800M", "4G", "1.5G": powers of 1024. Nothing for other words, and for less than kLeastBudget, in
// which not even the program itself has room.
inline constexpr std::uint64_t kLeastBudget = std::uint64_t{16} << 20;
std::optional<std::uint64_t> memory_size(std::string_view words);
// "3.3 GB": powers of 1024; at least 1 KB. For memory and files alike.
std::string memory_text(std::uint64_t bytes);

// Throws Refused if `bytes` are more than the budget: "<what> need about 3.3 GB, the budget is
// 1 GB; <advice>, or --memory 4G".
void require_memory(std::uint64_t bytes, std::string_view what, std::string_view advice);
// Throws that.
[[noreturn]] void refuse_memory(std::uint64_t bytes, std::string_view what,
                                std::string_view advice);

}  // namespace lantern
