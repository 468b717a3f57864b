// Printing a page as PDF by whichever Chromium is installed, and what is on which of its pages. The
// browser runs as a child; it fetches nothing but the page. Any thread.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "runtime/core/atomic_file.hpp"

namespace luxodus {

/// Errors: no Chromium is installed, or none printed it; with what it said then.
Result<void> print_pdf(const std::filesystem::path& page, const std::filesystem::path& pdf);

/// Number of the page, from 1, that each named destination of a PDF is on, as Chromium writes them
/// for links within a document. Empty where the file has none or is written another way.
std::map<std::string, int> pages_of_destinations(std::string_view pdf);

}  // namespace luxodus
