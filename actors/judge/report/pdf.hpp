// Prints a page as PDF by an installed Chromium, and finds the page numbers of headings. The
// browser runs as a child process and fetches nothing but the page. Any thread.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "runtime/core/atomic_file.hpp"

namespace luxodus {

/// Errors: no Chromium is installed, or none printed the page, with its message.
Result<void> print_pdf(const std::filesystem::path& page, const std::filesystem::path& pdf);

/// Page number, from 1, of each named destination of a PDF, in the form that Chromium writes for
/// links within a document. Empty if the file has none or another form.
std::map<std::string, int> pages_of_destinations(std::string_view pdf);

}  // namespace luxodus
