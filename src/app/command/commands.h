// The commands. Each gets its settings and leaves with the program's exit code.
#pragma once

#include "app/options/settings.h"
#include "base/exit_code.h"
#include "base/result.h"

#include <cstdint>
#include <string>

namespace scanout::app {

// The whole program: parses, runs, reports.
Exit run(int argc, char** argv);

// `start_bytes`: the resident memory before anything was done, for the reports.
Result<Exit> run_view(const Settings& settings, std::uint64_t start_bytes);
Result<Exit> run_render(const Settings& settings, std::uint64_t start_bytes);
Result<Exit> run_explain(const Settings& settings);
Result<Exit> run_frontier(const Settings& settings);
Result<Exit> run_doctor(const Settings& settings);
Result<Exit> run_info(const Settings& settings);
Result<Exit> run_compare(const Settings& settings);
Result<Exit> run_spectrum(const Settings& settings);
Result<Exit> run_colour(const Settings& settings);
Result<Exit> run_synthesise(const Settings& settings);
Result<Exit> run_list(const Settings& settings);
Result<Exit> run_generate(const Settings& settings);
Result<Exit> run_restore(const Settings& settings);

// What `list` and `generate` can be asked for, with spaces between the words.
std::string list_topics();
std::string generated_words();

} // namespace scanout::app
