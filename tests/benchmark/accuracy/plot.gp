# Work-precision diagrams from the CSV of accuracy_benchmark.
# In: variables csv (file) and folder. Out: folder/accuracy-{whole-log,instants,count}.svg
# gnuplot -e "csv='accuracy.csv'; folder='.'" plot.gp

set datafile separator ','
set datafile missing NaN
set encoding utf8

# Colours of Okabe and Ito, told apart by the colour-blind; shapes tell methods apart without any.
array name[10] = ["piblocks::PairLog", "closed form; two-sided", "closed form; one-sided", \
  "closed form; oracle", "velocity-only loop", "gap loop", "article's loop", \
  "piblocks::EventSimulator", "fixed-step Euler", "CVODE Adams"]
array title_[10] = ["piblocks::PairLog", "closed form, two-sided, bare", \
  "closed form, one-sided", "closed form, oracle of the tests", "velocity-only loop", "gap loop", \
  "article's loop", "piblocks::EventSimulator", "fixed-step Euler (h)", "CVODE Adams (tolerance)"]
array colour[10] = ["#D55E00", "#E69F00", "#0072B2", "#000000", "#009E73", "#56B4E9", "#CC79A7", \
  "#000000", "#8C564B", "#5C5C8A"]
array shape[10] = [7, 5, 9, 3, 11, 13, 15, 6, 2, 1]
do for [i=1:10] { set linetype i lc rgb colour[i] pt shape[i] ps 0.75 lw 1.6 }
set linetype 1 ps 1.1

# One number of a row, if the row is of this question and method; of `digits` digits.
is(question, i) = strcol('question') eq question && strcol('method') eq name[i]
at_digits(question, i, d, value) = is(question, i) && column('digits') == d ? value : NaN
number(key) = strlen(strcol(key)) > 0 ? column(key) : NaN
# A logarithmic axis has no zero.
error(key) = number(key) > 0 ? number(key) : NaN

set grid lc rgb "#DDDDDD" lw 0.6
set border lc rgb "#444444"
set key off

legend = "unset title; unset xlabel; unset ylabel; unset tics; unset border; unset grid; \
  unset logscale; unset label; set xrange [0:1]; set yrange [0:1]; \
  set lmargin at screen 0.02; set rmargin at screen 0.98; \
  set tmargin at screen 0.17; set bmargin at screen 0.01; \
  set key center center maxrows 3 samplen 2 width -2 spacing 1.25 font ',12'; \
  plot for [i in '1 2 3 5 6 7 8 9 10'] NaN with linespoints lt int(i) title title_[int(i)]"

# Three panels side by side: 3, 6 and 9 digits of pi.
panel(p) = sprintf("set lmargin at screen %g; set rmargin at screen %g; \
  set tmargin at screen 0.92; set bmargin at screen 0.32", 0.07 + 0.31 * p, 0.355 + 0.31 * p)

# Events of a log with a wrong count are not comparable.
comparable(value) = strcol('count_right') eq "no" ? NaN : value
# Errors of methods over the budget are known from single events; their points are at the top.
top_s = 20
time_or_top(unused) = strcol('seconds') eq "" ? top_s : column('seconds')

array asked[2] = ["whole log", "instants"]
array file[2] = ["whole-log", "instants"]
array axis[2] = ["worst position error, block widths", "worst error of blue, block widths"]
do for [n=1:2] {
  set terminal svg size 1200,560 dynamic font "DejaVu Sans,13" background "white"
  set output folder."/accuracy-".file[n].".svg"
  set multiplot
  set logscale xy
  set xrange [1e-50:1e2]
  set yrange [2e-6:4e1]
  set xtics 1e-40, 1e10
  set ytics 1e-6, 10
  set mxtics 1
  set mytics 1
  set xlabel axis[n]
  set format xy "10^{%L}"
  set border
  set grid lc rgb "#DDDDDD" lw 0.6
  set key off
  do for [p=0:2] {
    d = 3 * p + 3
    eval panel(p)
    set title sprintf("%s, %d digits", asked[n], d)
    if (p == 0) { set ylabel "processor time, s" } else { unset ylabel; set format y "" }
    unset label
    if (n == 1 && d == 9) {
      set label "top edge: over the budget" at graph 0.04, 0.9 font ",11"
    }
    plot for [i=1:10] csv \
      using (comparable(at_digits(asked[n], i, d, error('worst_position_error')))) \
        :(time_or_top(0)) \
      with linespoints lt i
  }
  eval legend
  unset multiplot
  unset output
  set tics
}

# The count has no error to plot but being wrong: time against the number of collisions.
reset
set datafile separator ','
set datafile missing NaN
set terminal svg size 1000,640 dynamic font "DejaVu Sans,13" background "white"
set output folder."/accuracy-count.svg"
set logscale xy
set format xy "10^{%L}"
set xrange [2:1e9]
set yrange [1e-6:1e2]
set grid lc rgb "#DDDDDD" lw 0.6
set border lc rgb "#444444"
set title "count only (Euler: h = 1e-5, CVODE: tolerance 1e-8); crossed out where it is wrong"
set xlabel "number of collisions"
set ylabel "processor time, s"
set key outside right center Left reverse samplen 2 spacing 1.4
# One line a method: in double, with one step or tolerance.
plain(i) = strcol('scalar') eq "double" && (strcol('parameter') eq "" \
  || strcol('parameter') eq "h=1e-05" || strcol('parameter') eq "tol=1e-08") \
  || strcol('method') eq name[4]
counted(i, value) = is("count", i) && plain(i) ? value : NaN
miscounted(i) = counted(i, strcol('count_right') eq "no" ? number('seconds') : NaN)
plot for [i=1:10] csv using (counted(i, column('events'))):(number('seconds')) \
    with linespoints lt i title title_[i], \
  for [i=1:10] csv using (counted(i, column('events'))):(miscounted(i)) \
    with points pt 2 ps 1.6 lw 2 lc rgb "#D00000" notitle
unset output
