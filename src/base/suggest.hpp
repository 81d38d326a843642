// The known name nearest to a misspelt one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lantern {

// The candidate that is the fewest slips away from `name` (a letter missing, too many, or another
// one, or two neighbours that have changed places; case ignored), the first of equals;
// nothing if even that one differs in more than a third of its letters (but two are always allowed
// for names of four letters and more).
std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string_view> candidates);

// "did you mean 'x'?", and a list of the candidates where there are others and at most `most`.
std::string suggestion(std::string_view name, std::span<const std::string_view> candidates,
                       std::size_t most = 12);

// "<message>; <suggestion>", or the message alone where there is nothing to suggest.
std::string with_suggestion(std::string message, std::string_view name,
                            std::span<const std::string_view> candidates, std::size_t most = 12);

// Throws Refused if the name of a thing that a program adds of its own, a "panel", is not of a–z,
// 0–9 and _, or if it is taken.
void require_own_name(std::string_view thing, std::string_view name, bool is_taken);

}  // namespace lantern
