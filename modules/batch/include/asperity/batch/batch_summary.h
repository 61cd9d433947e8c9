#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/batch/batch_record.h"

namespace asperity {

// A row of the summary: one result of one scan (a scan of several segments has several), or a scan that failed.
struct SummaryRow {
  std::string name;  // NAME, or NAME/SEGMENT
  std::string recording;
  std::string status;              // "valid", "limited", "invalid" (the verdicts' worst) or "failed"
  std::string failed_step;         // of a failed scan
  std::string message;             // of a failed scan, or the worst verdict's
  std::vector<std::string> codes;  // of all verdicts, "severity:code"
  std::vector<std::string> cells;  // one for each of summary_columns(); empty: not determined, or not asked for
  std::string report;              // relative to the folder of the results; empty: there is none
};

// The names of the measured values, with units, and their standard errors or 95 % limits.
std::vector<std::string> summary_columns();

// The rows of one scan, read from what its steps have written. `results` is the folder of all results.
std::vector<SummaryRow> summarise_scan(const ScanRecord& record, const std::filesystem::path& results);

// summary.csv: a header and a row for each, quoted as in RFC 4180 where a cell needs it.
std::string format_summary_csv(const std::vector<SummaryRow>& rows);

// index.html: the same as a page that needs nothing else, with links to the reports.
std::string format_summary_page(const std::vector<SummaryRow>& rows);

}  // namespace asperity
