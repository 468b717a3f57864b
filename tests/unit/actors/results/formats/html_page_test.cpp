#include "actors/results/formats/html_page.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

TEST_CASE("a page states its language, its title as text, and its style before its body",
          "[output][html]") {
  const std::string page = html_page({"de", "A <b> & C", "p { color: red; }\n"}, "<p>here</p>\n");
  CHECK(page.rfind("<!doctype html>\n<html lang=\"de\">\n", 0) == 0);
  CHECK(page.find("<title>A &lt;b&gt; &amp; C</title>") != std::string::npos);
  CHECK(page.find("<style>\np { color: red; }\n</style>") < page.find("<p>here</p>"));
  CHECK(page.ends_with("<p>here</p>\n</body>\n</html>\n"));
}
