# The tables of speed/README.md, and the short one of the project's README.md, from the CSV of
# speed_benchmark.
# awk -f page.awk -f speed/tables.awk speed.csv README.md
BEGIN {
  if (page == "README.md") allowed = "speed-short"
  else names = "measured job encoders"
}

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
  else if (name == "job") print_job()
  else if (name == "encoders") print_encoders()
  else print_short()
}

function get(row, name) {
  if (!((row, name) in field)) fail("no column " name)
  return field[row, name]
}
function is(row, group, series) {
  return get(row, "group") == group && get(row, "series") == series
}

# The program runs in both series, and is shown once.
function is_job(row) {
  return is(row, "job", "encoding") || \
    is(row, "job", "drawing") && get(row, "name") != "piblocks"
}

# Numbers as one reads them.
function number_text(x) {
  if (x == "") return dash
  return x >= 100 ? sprintf("%.0f", x) : sprintf("%.3g", x)
}
function memory_text(row) { return number_text(get(row, "peak_MB")) " MB" }
function per_frame(row, name) { return get(row, name) / get(row, "frames") }
function ratio_text(row,    least, greatest) {
  least = number_text(get(row, "least_ratio"))
  greatest = number_text(get(row, "greatest_ratio"))
  return number_text(get(row, "ratio")) (least == greatest ? "" : " (" least " … " greatest ")")
}
# What all rows of programs have in common.
function speed_cells(row) {
  return get(row, "frames") " | " time_text(get(row, "seconds")) " | " \
    number_text(get(row, "frames_per_second")) " | " \
    time_text(per_frame(row, "cpu_seconds")) " | " memory_text(row)
}
function speed_head() { return "Frames | Time | Frames/s | Processor time a frame | Memory" }

function print_measured(    row, versions, version) {
  for (row = 1; row <= rows; ++row) {
    version = get(row, "version")
    if (index(versions ", ", ", " version ", ") == 0) versions = versions ", " version
  }
  print "Measured " get(1, "date") " on " article(get(1, "cpu")) ", " \
    get(1, "processors") " processors, " get(1, "compiler") ", preset `release`, commit " \
    get(1, "commit") ": " substr(versions, 3) "."
}

function print_job(    row) {
  print "| Program | " speed_head() " | kB a second of video | Time a frame, piblocks = 1 |"
  print_rule(1, 7)
  for (row = 1; row <= rows; ++row) {
    if (!is_job(row)) continue
    print "| " get(row, "name") " | " speed_cells(row) " | " \
      number_text(per_frame(row, "output_MB") * 60 * 1000) " | " ratio_text(row) " |"
  }
}

function print_encoders(    row) {
  print "| Frame size | Encoder | " speed_head() " | kB a second of video | PSNR, dB | Worst frame, dB" \
    " | SSIM | Time, piblocks = 1 |"
  print "|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
  for (row = 1; row <= rows; ++row) {
    if (get(row, "group") != "encoders") continue
    print "| " value_text(row) " | " get(row, "name") " | " speed_cells(row) " | " \
      number_text(per_frame(row, "output_MB") * 60 * 1000) " | " get(row, "psnr_dB") " | " \
      get(row, "least_psnr_dB") " | " get(row, "ssim") " | " ratio_text(row) " |"
  }
}

function value_text(row,    text) {
  text = get(row, "value")
  if (text ~ /^[0-9]+x[0-9]+$/) sub(/x/, "×", text)
  return text
}

function print_short(    row) {
  print "| Program | Frames/s | Time a frame, piblocks = 1 |"
  print_rule(1, 2)
  for (row = 1; row <= rows; ++row) {
    if (!is_job(row)) continue
    print "| " get(row, "name") " | " number_text(get(row, "frames_per_second")) " | " \
      number_text(get(row, "ratio")) " |"
  }
}
