#include "actors/apps/cli/report_aloud.hpp"

#include <chrono>
#include <optional>

#include "actors/apps/cli/progress_line.hpp"

namespace luxodus::cli {

Result<Json> finish_report_aloud(const std::filesystem::path& folder, const LocalRun& run,
                                 const RunRecord& record) {
  constexpr auto moment = std::chrono::seconds(2);
  const auto began = std::chrono::steady_clock::now();
  std::optional<ProgressLine> line;
  return finish_results(folder, run, record, [&](double share) {
    if (!line && std::chrono::steady_clock::now() - began > moment) line.emplace("direct light");
    if (line) line->show_share(share);
  });
}

}  // namespace luxodus::cli
