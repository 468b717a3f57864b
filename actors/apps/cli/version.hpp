// What this program is, and what it was built with. Constant data; any thread.
#pragma once

namespace luxodus::cli {

struct Build {
  const char* version;       // "0.1.0"
  const char* commit;        // "1a2b3c4d5e6f", with "+" appended if files had changed; or "unknown"
  const char* type;          // "Release"
  const char* architecture;  // "x86-64-v3": the instruction set that it uses
  const char* built_for;     // builds whose bits are equal, and which may trace together
  const char* packages;      // "NAME VERSION", a line each
};

extern const Build build;

}  // namespace luxodus::cli
