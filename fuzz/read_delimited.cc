#include "asperity/import/read_delimited.h"

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  DelimitedTable table;
  try {
    table = read_delimited(std::string(fuzz_text(data, size)), "table.csv");
  } catch (const Error&) {
    return 0;
  }
  must(table.rows() > 0 && !table.columns.empty() && table.columns.size() <= 1000);
  must(table.row_line.size() == table.rows());
  for (const DelimitedColumn& column : table.columns) {
    must(column.values.size() == table.rows());
    must(is_utf8(column.name) && is_utf8(column.unit));
  }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    must(row == 0 || table.row_line[row] > table.row_line[row - 1]);
    must(table.row_begin[row] < table.text.size());
  }
  table.cell(table.rows() - 1, table.columns.size() - 1);
  return 0;
}
