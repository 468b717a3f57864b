// Numbers and text for output files: numbers in the shortest form that reads back to the same bits,
// rounded numbers for people, valid UTF-8, and text escaped for XML. Pure functions; any thread.
#pragma once

#include <string>
#include <string_view>

namespace luxodus {

/// The shortest decimal that reads back to the same double; else "nan", "inf" or "-inf".
/// Independent of the locale.
std::string shortest_number(double value);

/// For people: `digits` significant digits, plain between 0.001 and 99999 ("0.0421", "1230"), else
/// as a power of ten ("1.2·10⁶"). "no value" for NaN. digits: 1..9.
std::string readable_number(double value, int digits = 3);

/// "10⁻³" for -3.
std::string power_of_ten(int exponent);

/// Replaces every byte that is not part of well-formed UTF-8, and every control character except
/// tab and line feed, by U+FFFD.
std::string clean_utf8(std::string_view text);

/// clean_utf8, then & < > " ' escaped: safe as XML text and inside an attribute in quotes. Tabs and
/// line feeds become character references, so that attributes keep them.
std::string xml_escape(std::string_view text);

}  // namespace luxodus
