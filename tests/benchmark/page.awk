# A page with its tables made anew: what the tables.awk of all benchmarks share.
# In: CSVs, then the page. Out: the page with new tables between its marks, "<!-- table NAME -->" and
# "<!-- end of table -->"; fails where a mark is unknown or missing.
# awk -f page.awk -f SUBJECT/tables.awk CSV… PAGE
# A subject's file sets `names`, the tables that its page must have, and `allowed`, those that it may
# have; it reads the rows of the CSVs, whose fields value() returns, and defines print_table(name).
BEGIN {
  FS = ","
  page = ARGV[ARGC - 1]
  dash = "–"
}

function fail(message) {
  print "page.awk: " message > "/dev/stderr"
  failed = 1
  exit 1
}

FILENAME == page {
  copy_line()
  next
}
FNR == 1 {
  ++file
  for (i = 1; i <= NF; ++i) column[file, $i] = i
  next
}

END {
  if (failed) exit 1
  if (skipping) fail("a table has no end")
  if (made != split(names, unused, " ")) fail(page " has " made + 0 " tables of: " names)
}

function copy_line(    table) {
  if (/^<!-- end of table -->$/) skipping = 0
  if (!skipping) print
  if (!/^<!-- table /) return
  table = $0
  gsub(/^<!-- table | -->$/, "", table)
  if (has_word(names, table)) ++made
  else if (!has_word(allowed, table)) fail("unknown table: " table)
  print ""
  print_table(table)
  print ""
  skipping = 1
}

function has_word(words, word) { return index(" " words " ", " " word " ") > 0 }

# A field of a CSV's row, by its column's name.
function value(name) {
  if (!((file, name) in column)) fail("no column " name)
  return $column[file, name]
}

function article(cpu) { return (cpu ~ /^[AEIOU]/ ? "an " : "a ") cpu }

# Numbers as one reads them.
function time_text(s) {
  if (s == "") return dash
  if (s < 1e-3) return sprintf("%.3g µs", s * 1e6)
  return s < 1 ? sprintf("%.3g ms", s * 1e3) : sprintf("%.3g s", s)
}

function print_rule(columns, rights,    line) {
  for (line = "|"; columns-- > 0;) line = line "---|"
  while (rights-- > 0) line = line "---:|"
  print line
}
