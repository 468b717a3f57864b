#include "actors/judge/report/pdf.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "actors/results/formats/run_program.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// Limits: pages that are read from a PDF, and depth of its page tree.
constexpr size_t pdf_pages = 10'000;
constexpr int tree_depth = 20;

/// Objects of a PDF outside streams, by number.
using Objects = std::map<int, std::string_view>;

std::optional<int> number_at(std::string_view text, size_t& at) {
  while (at < text.size() && (text[at] == ' ' || text[at] == '\n' || text[at] == '\r')) ++at;
  int value = 0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  at = static_cast<size_t>(end - text.data());
  return value;
}

Objects objects_of(std::string_view pdf) {
  Objects out;
  constexpr std::string_view mark = " 0 obj";
  for (size_t at = pdf.find(mark); at != std::string_view::npos; at = pdf.find(mark, at + 1)) {
    size_t from = at;
    while (from > 0 && pdf[from - 1] >= '0' && pdf[from - 1] <= '9') --from;
    size_t digits = from;
    const auto number = number_at(pdf, digits);
    const size_t end = std::min(pdf.find("endobj", at), pdf.find("stream", at));
    if (from < at && number && end != std::string_view::npos)
      out[*number] = pdf.substr(at + mark.size(), end - at - mark.size());
  }
  return out;
}

/// Adds the leaves of the page tree in their order.
void add_pages(const Objects& objects, int node, int depth, std::vector<int>& out) {
  const auto at = objects.find(node);
  if (at == objects.end() || depth > tree_depth || out.size() > pdf_pages) return;
  const size_t kids = at->second.find("/Kids [");
  if (kids == std::string_view::npos) {
    out.push_back(node);
    return;
  }
  const size_t close = at->second.find(']', kids);
  for (size_t from = kids + 7; from < std::min(close, at->second.size());) {
    const auto kid = number_at(at->second, from);
    if (!kid) return;
    add_pages(objects, *kid, depth + 1, out);
    from = at->second.find('R', from);
    if (from == std::string_view::npos) return;
    ++from;
    while (from < close && at->second[from] <= ' ') ++from;
  }
}

/// The object to which a key refers: "/Pages 5 0 R".
std::optional<int> reference(std::string_view object, std::string_view key) {
  size_t at = object.find(key);
  if (at == std::string_view::npos) return std::nullopt;
  at += key.size();
  return number_at(object, at);
}

}  // namespace

Result<void> print_pdf(const fs::path& page, const fs::path& pdf) {
  const std::string address = "file://" + fs::absolute(page).string();
  const fs::path said = pdf.string() + ".browser.txt";
  std::error_code ignored;
  std::string failed;
  fs::remove(pdf, ignored);
  for (const char* browser : {"chromium", "chromium-browser", "google-chrome"}) {
    std::vector<std::string> words{browser,
                                   "--headless=new",
                                   "--disable-gpu",
                                   "--log-level=3",
                                   "--no-pdf-header-footer",
                                   "--generate-pdf-document-outline",
                                   "--print-to-pdf=" + fs::absolute(pdf).string()};
    // Chromium has no sandbox for root; the page is ours and fetches nothing.
    if (::geteuid() == 0) words.emplace_back("--no-sandbox");
    words.push_back(address);
    const auto ran = run_program(words, said);
    const bool printed = ran && ran.value() == 0 && fs::exists(pdf, ignored);
    if (!printed && !(ran && ran.value() == -1))
      failed = std::string(browser) + " did not print it" + last_words(said);
    fs::remove(said, ignored);
    if (printed) return {};
  }
  return problem_in(pdf, failed.empty()
                             ? "no Chromium is installed to print it: install one (Debian: "
                               "chromium), or print " +
                                   page.filename().string() + " from a browser"
                             : failed);
}

std::map<std::string, int> pages_of_destinations(std::string_view pdf) {
  const Objects objects = objects_of(pdf);
  std::optional<int> root, dests;
  for (const auto& [number, object] : objects)
    if (object.find("/Type /Catalog") != std::string_view::npos) {
      root = reference(object, "/Pages ");
      dests = reference(object, "/Dests ");
    }
  std::map<std::string, int> out;
  if (!root || !dests || !objects.contains(*dests)) return out;
  std::vector<int> pages;
  add_pages(objects, *root, 0, pages);
  const std::string_view names = objects.at(*dests);
  for (size_t at = names.find('/'); at != std::string_view::npos; at = names.find('/', at + 1)) {
    const size_t open = names.find(" [", at);
    if (open == std::string_view::npos) break;
    const std::string name(names.substr(at + 1, open - at - 1));
    size_t from = open + 2;
    const auto page = number_at(names, from);
    for (size_t i = 0; page && i < pages.size(); ++i)
      if (pages[i] == *page) out[name] = static_cast<int>(i + 1);
    at = names.find(']', open);
    if (at == std::string_view::npos) break;
  }
  return out;
}

}  // namespace luxodus
