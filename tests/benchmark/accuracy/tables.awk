# The tables of tests/benchmark/README.md, from the CSVs of accuracy_benchmark.
# awk -f page.awk -f accuracy/tables.awk accuracy.csv accuracy-ratio.csv README.md
BEGIN { names = "measured ratio" }

file == 1 {
  measured = value("date") " on " article(value("cpu")) ", " value("compiler") ", preset" \
    " `release`, commit " value("commit")
}
file == 2 {
  ++ratios
  for (i = 1; i <= NF; ++i) ratio_field[ratios, i] = $i
}

function print_table(name) {
  if (name == "measured") print "Measured " measured "."
  else print_ratio()
}

function ratio_value(row, name) {
  if (!((2, name) in column)) fail("no column " name)
  return ratio_field[row, column[2, name]]
}
function rate_text(row, name) {
  return sprintf("%.3g", ratio_value(row, "events") / ratio_value(row, name) / 1e6)
}
function print_ratio(    i) {
  print "| d | loop (double) | program, million events/s | loop, million events/s | ratio |" \
    " ratios of single pairs |"
  print_rule(2, 4)
  for (i = 1; i <= ratios; ++i) {
    print "| " ratio_value(i, "digits") " | " ratio_value(i, "loop") " | " \
      rate_text(i, "program_seconds") " | " rate_text(i, "loop_seconds") " | " \
      ratio_value(i, "ratio") " | " ratio_value(i, "least_ratio") " … " \
      ratio_value(i, "greatest_ratio") " |"
  }
}
