# The tables of tests/benchmark/README.md, from the CSVs of accuracy_benchmark.
# awk -f page.awk -f accuracy/tables.awk accuracy.csv accuracy-ratio.csv README.md
BEGIN {
  names = "measured whole-log instants count front-whole-log front-instants front-count"
  names = names " limits ratio"
  # What one machine repeats no better: the last digits of an error are luck, and other programs
  # share the caches.
  time_slack = 1.1
  error_slack = 2
  max_digits = 9
}

file == 1 { read_measurement() }
file == 2 {
  ++ratios
  for (i = 1; i <= NF; ++i) ratio_field[ratios, i] = $i
}

# Rows are known by question, curve point and digits: seconds[question, point, digits].
function read_measurement(    question, point, d) {
  question = value("question")
  point = value("method") "," value("scalar") "," value("parameter")
  d = value("digits")
  if (!((question, point) in seen)) {
    seen[question, point] = 1
    point_of[question, ++points[question]] = point
  }
  seconds[question, point, d] = value("seconds")
  time_error[question, point, d] = value("worst_time_error")
  position_error[question, point, d] = value("worst_position_error")
  count[question, point, d] = value("count")
  right[question, point, d] = value("count_right")
  if (value("note") ~ /budget/) over_budget[question, point, d] = 1
  measured = value("date") " on " article(value("cpu")) ", " value("compiler") ", preset" \
    " `release`, commit " value("commit")
}

function print_table(name) {
  if (name == "measured") print "Measured " measured "."
  else if (name == "whole-log") print_whole_log()
  else if (name == "instants") print_instants()
  else if (name == "count") print_count()
  else if (name == "front-whole-log") print_front("whole log")
  else if (name == "front-instants") print_front("instants")
  else if (name == "front-count") print_front("count")
  else if (name == "limits") print_limits()
  else print_ratio()
}

# Numbers as one reads them.
function error_text(e,    text) {
  if (e == "") return dash
  if (exact(e) == 0) return "0"
  if (e >= 1) return sprintf("%.2g", e)
  text = sprintf("%.0e", e)
  sub(/e-0/, "e-", text)
  return text == "1e+00" ? "1" : text
}
# The reference has a hundred digits: less than this is its own rounding.
function exact(e) { return e < 1e-90 ? 0 : e + 0 }

function method_of(point,    part) {
  split(point, part, ",")
  gsub(/;/, ",", part[1])
  return part[1]
}
function type_of(point,    part) {
  split(point, part, ",")
  gsub(/e-0/, "e-", part[3])
  return part[3] == "" ? part[2] : part[2] ", " part[3]
}
function is_reference(point) { return point ~ /^closed form; oracle/ }

function print_whole_log(    i, d, p, line) {
  line = "| Method | Number type |"
  for (d = 3; d <= 9; d += 3) line = line " d = " d ": time | time error | position error |"
  print line
  print_rule(2, 9)
  for (i = 1; i <= points["whole log"]; ++i) {
    p = point_of["whole log", i]
    line = "| " method_of(p) " | " type_of(p) " |"
    for (d = 3; d <= 9; d += 3) line = line whole_log_cells(p, d)
    print line
  }
}
function whole_log_cells(p, d,    time) {
  time = " " time_text(seconds["whole log", p, d]) " |"
  if (right["whole log", p, d] == "no") return time " wrong count | " dash " |"
  return time " " error_text(time_error["whole log", p, d]) " | " \
    error_text(position_error["whole log", p, d]) " |"
}

function print_instants(    i, d, p, line) {
  line = "| Method | Number type |"
  for (d = 3; d <= 9; d += 3) line = line " d = " d ": time | error |"
  print line
  print_rule(2, 6)
  for (i = 1; i <= points["instants"]; ++i) {
    p = point_of["instants", i]
    line = "| " method_of(p) " | " type_of(p) " |"
    for (d = 3; d <= 9; d += 3) {
      line = line " " time_text(seconds["instants", p, d]) " | " \
        (is_reference(p) ? "reference" : error_text(position_error["instants", p, d])) " |"
    }
    print line
  }
}

function print_count(    i, d, p, line) {
  line = "| Method | Number type |"
  for (d = 3; d <= 9; d += 3) line = line " d = " d ": time | count |"
  print line
  print_rule(2, 6)
  for (i = 1; i <= points["count"]; ++i) {
    p = point_of["count", i]
    line = "| " method_of(p) " | " type_of(p) " |"
    for (d = 3; d <= 9; d += 3) {
      line = line " " time_text(seconds["count", p, d]) " | " count_text(p, d) " |"
    }
    print line
  }
}
function count_text(p, d) {
  if (count["count", p, d] == "") return dash
  return right["count", p, d] == "yes" ? "right" : count["count", p, d]
}

# Has a time, and an answer that can be compared.
function competes(q, p, d) {
  if (seconds[q, p, d] == "" || right[q, p, d] == "no") return 0
  if (q == "count") return 1
  return !is_reference(p) && position_error[q, p, d] ~ /^[0-9]/
}
function no_worse(a, b) { return exact(a) <= error_slack * exact(b) }
function better(a, b) { return error_slack * exact(a) < exact(b) }
function beats(q, a, b, d,    ta, tb) {
  ta = seconds[q, a, d] + 0
  tb = seconds[q, b, d] + 0
  if (ta > time_slack * tb) return 0
  if (!no_worse(time_error[q, a, d], time_error[q, b, d])) return 0
  if (!no_worse(position_error[q, a, d], position_error[q, b, d])) return 0
  return time_slack * ta < tb || better(time_error[q, a, d], time_error[q, b, d]) || \
    better(position_error[q, a, d], position_error[q, b, d])
}

# The fastest of those that beat a point; "" if nothing does.
function beaten_by(q, p, d,    i, other, best) {
  best = ""
  for (i = 1; i <= points[q]; ++i) {
    other = point_of[q, i]
    if (!competes(q, other, d) || !beats(q, other, p, d)) continue
    if (best == "" || seconds[q, other, d] + 0 < seconds[q, best, d] + 0) best = other
  }
  return best
}

function print_front(q,    d) {
  print "| d | On the front, fastest first | piblocks::CollisionLog |" \
    " closed form, two-sided, double |"
  print_rule(4, 0)
  for (d = 1; d <= max_digits; ++d) {
    print "| " d " | " front_text(q, d) " | " standing(q, "piblocks::CollisionLog,double,", d) \
      " | " standing(q, "closed form; two-sided,double,", d) " |"
  }
}
function front_text(q, d,    i, p, n, fastest, text, front) {
  n = 0
  for (i = 1; i <= points[q]; ++i) {
    p = point_of[q, i]
    if (competes(q, p, d) && beaten_by(q, p, d) == "") front[++n] = p
  }
  text = ""
  for (; n > 0; front[fastest] = front[n--]) {
    fastest = 1
    for (i = 2; i <= n; ++i) {
      if (seconds[q, front[i], d] + 0 < seconds[q, front[fastest], d] + 0) fastest = i
    }
    text = text (text == "" ? "" : "; ") entry_text(q, front[fastest], d)
  }
  return text
}
function entry_text(q, p, d,    text) {
  text = method_of(p) " (" type_of(p) ") " time_text(seconds[q, p, d])
  return q == "count" ? text : text ", " error_text(position_error[q, p, d])
}
function standing(q, p, d,    winner) {
  if (!competes(q, p, d)) return "not timed"
  winner = beaten_by(q, p, d)
  return winner == "" ? "on it" : time_text(seconds[q, p, d]) ", behind " method_of(winner) \
    " (" type_of(winner) ")"
}

# Where methods that step from collision to collision, or through time, fail.
function print_limits(    i, p) {
  print "| Method | Number type | count wrong from d = | blue off by 1e-6 or more from d = |" \
    " log over the budget from d = |"
  print_rule(2, 3)
  for (i = 1; i <= points["whole log"]; ++i) {
    p = point_of["whole log", i]
    if (p ~ /^closed form|^piblocks::CollisionLog/) continue
    print "| " method_of(p) " | " type_of(p) " | " first_wrong(p) " | " first_off(p) " | " \
      first_over(p) " |"
  }
}
function first_wrong(p,    d) {
  for (d = 1; d <= max_digits; ++d) if (right["count", p, d] == "no") return d
  return dash
}
function first_off(p,    d) {
  for (d = 1; d <= max_digits; ++d) if (position_error["instants", p, d] >= 1e-6) return d
  return dash
}
function first_over(p,    d) {
  for (d = 1; d <= max_digits; ++d) if (("whole log", p, d) in over_budget) return d
  return dash
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
