#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace asperity {

// The number that the whole of `text` spells, blanks at its ends apart; "nan" and "inf" are numbers.
std::optional<double> parse_double(std::string_view text);
std::optional<std::int64_t> parse_int64(std::string_view text);

// Appends the shortest text that reads back as exactly `value`.
void append_number(std::string& out, double value);
void append_number(std::string& out, std::int64_t value);
std::string number_text(double value);

// Appends `value` rounded to 12 decimals, without the zeros at their end: a quarter of the time of the shortest exact
// text and less than three quarters of its length, for what no measurement knows to a picometre. From 1000 on, exactly.
void append_decimals(std::string& out, double value);

// A number as it is written in our text files: whole numbers without exponent or point, others as the
// shortest text that reads back exactly.
void append_exact(std::string& out, double value);

// True if `text` is well-formed UTF-8.
bool is_utf8(std::string_view text);

// `text` cut to `limit` bytes with what is not UTF-8, and every character that controls a terminal or the
// order of what is read (C0, C1, bidirectional, separators), written as \xNN, for messages.
std::string printable(std::string_view text, std::size_t limit = 60);

std::string_view trim(std::string_view text);

}  // namespace asperity
