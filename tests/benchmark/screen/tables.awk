# The tables of screen/README.md, from the CSV of screen_benchmark.
# awk -f page.awk -f screen/tables.awk screen.csv README.md
BEGIN { names = "measured changed qp-14 qp-26" }

# Rows are known by number: field[row, column's name].
{
  ++rows
  for (key in column) {
    split(key, part, SUBSEP)
    field[rows, part[2]] = value(part[2])
  }
}

function print_table(name) {
  if (name == "measured") print_measured()
  else if (name == "changed") print_changed()
  else print_encoders(substr(name, 4))
}

function get(row, name) {
  if (!((row, name) in field)) fail("no column " name)
  return field[row, name]
}

function print_measured(    row, version, versions) {
  for (row = 1; row <= rows; ++row) {
    version = get(row, "version")
    if (index(versions ", ", ", " version ", ") == 0) versions = versions ", " version
  }
  print "Measured " get(1, "date") " on " article(get(1, "cpu")) ", " \
    get(1, "processors") " processors, " get(1, "compiler") ", preset `release`, commit " \
    get(1, "commit") ", median of " get(1, "runs") " runs: " substr(versions, 3) "."
}

function print_changed(    row, material, last) {
  print "| Material | Share of the pixels in the rectangles, on average |"
  print_rule(1, 1)
  for (row = 1; row <= rows; ++row) {
    material = get(row, "material")
    if (material != last) print "| " material " | " percent(get(row, "changed_share")) " |"
    last = material
  }
}
function percent(share) { return sprintf("%.3g %%", 100 * share) }

function print_encoders(reference_qp,    row, first) {
  print "| Material | Encoder | QP | Processor time a picture | kB | PSNR, dB | Worst picture, dB" \
    " | Time, piblocks = 1 | Bytes, piblocks = 1 |"
  print_rule(2, 7)
  for (row = 1; row <= rows; ++row) {
    if (get(row, "reference_qp") != reference_qp) continue
    if (!(get(row, "material") in first)) first[get(row, "material")] = row
    print "| " get(row, "material") " | " get(row, "name") " | " qp_text(row) " | " \
      time_text(get(row, "cpu_seconds")) " | " sprintf("%.0f", get(row, "bytes") / 1000) " | " \
      get(row, "psnr_dB") " | " get(row, "least_psnr_dB") " | " ratio_text(row) " | " \
      sprintf("%.3g", get(row, "bytes") / get(first[get(row, "material")], "bytes")) " |"
  }
}
# With how many pictures the library quantised more coarsely.
function qp_text(row,    text) {
  text = get(row, "qp") == "" ? dash : get(row, "qp")
  if (get(row, "coarser_pictures") > 0) text = text " (more: " get(row, "coarser_pictures") ")"
  return text
}
function ratio_text(row,    least, greatest) {
  least = short(get(row, "least_ratio"))
  greatest = short(get(row, "greatest_ratio"))
  return short(get(row, "ratio")) (least == greatest ? "" : " (" least " … " greatest ")")
}
function short(x) { return x >= 100 ? sprintf("%.0f", x) : sprintf("%.3g", x) }
