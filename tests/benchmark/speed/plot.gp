# The program's speed beside others', and what it depends on, from the CSV of speed/measure.
# In: variables csv (file) and folder. Out: folder/speed.svg
# gnuplot -e "csv='speed.csv'; folder='.'" plot.gp

set datafile separator ','
set datafile missing NaN
set encoding utf8
set terminal svg size 1200,860 dynamic noenhanced font "DejaVu Sans,13" \
  background "white"
set output folder."/speed.svg"

# Of Okabe and Ito, told apart by the colour-blind.
own = "#D55E00"
colour(name) = name eq "piblocks" ? 0xD55E00 : 0x0072B2
pale_colour(name) = name eq "piblocks" ? 0xE69F00 : 0x56B4E9

is(group, series) = strcol('group') eq group && strcol('series') eq series
# The program runs in both series, and is shown once.
is_job(unused) = is('job', 'encoding') || (is('job', 'drawing') && strcol('name') ne 'piblocks')
speed = 'frames_per_second'

number(x) = sprintf(x < 100 ? "%.3g" : "%.0f", x)

# Bars from the top down, one for each row that is asked for; n counts them.
next(condition) = condition ? (n = n + 1, n) : NaN
left_end = 8
right_end = 30000
half = 0.34

set grid lc rgb "#DDDDDD" lw 0.6
set border lc rgb "#444444"
set key off
set style fill solid noborder
set multiplot

# A panel's place, in parts of the picture.
place(x0, x1, y0, y1) = sprintf("set lmargin at screen %g; set rmargin at screen %g; \
  set bmargin at screen %g; set tmargin at screen %g", x0, x1, y0, y1)

# Whole jobs: a logarithmic axis, because some are a hundred times as fast as others.
set logscale x
set format x "%.0f"
set xrange [left_end:right_end]
set xtics (10, 100, 1000)
unset ytics
set grid x noy
set xlabel "frames/s (logarithmic)"

eval place(0.20, 0.49, 0.60, 0.94)
set title "1080p video as MP4, all processors"
set yrange [8.6:0.4]
n = 0; plot csv using (left_end):(row = next(is_job(0))):(left_end):(column(speed)) \
    :(row - half):(row + half):(colour(strcol('name'))) with boxxyerror lc rgb variable, \
  n = 0, csv using (left_end):(next(is_job(0))):(strcol('name')) \
    with labels right offset char -0.7, 0, \
  n = 0, csv using (column(speed)):(next(is_job(0))):(number(column(speed))) \
    with labels left offset char 0.5, 0 font ",11"

eval place(0.69, 0.98, 0.60, 0.94)
set title "1080p as PNG files: 1 thread (pale), all processors"
set yrange [5.6:0.4]
single(unused) = is('png', 'png') && strcol('value') eq '1'
all(unused) = is('png', 'png') && strcol('value') ne '1'
n = 0; plot csv using (left_end):(row = next(single(0))):(left_end):(column(speed)) \
    :(row - half):(row):(pale_colour(strcol('name'))) with boxxyerror lc rgb variable, \
  n = 0, csv using (left_end):(row = next(all(0))):(left_end):(column(speed)) \
    :(row):(row + half):(colour(strcol('name'))) with boxxyerror lc rgb variable, \
  n = 0, csv using (left_end):(next(single(0))):(strcol('name')) \
    with labels right offset char -0.7, 0, \
  n = 0, csv using (column(speed)):(next(single(0)) - half / 2):(number(column(speed))) \
    with labels left offset char 0.5, 0 font ",10", \
  n = 0, csv using (column(speed)):(next(all(0)) + half / 2):(number(column(speed))) \
    with labels left offset char 0.5, 0 font ",10"

# What the program's speed depends on.
set style line 1 lc rgb own pt 7 ps 0.9 lw 1.8
set grid xtics ytics
set xtics auto
set ytics auto
set xlabel font ",12"
scaled(series, x) = is('scaling', series) ? x : NaN
x_of(size) = strstrt(size, 'x')
product(size) = real(size[1:x_of(size) - 1]) * real(size[x_of(size) + 1:strlen(size)])
megapixels(size) = is('scaling', 'size') ? product(size) / 1e6 : NaN

eval place(0.06, 0.245, 0.09, 0.44)
set title "MP4: frame size"
set xlabel "megapixels a frame"
set xrange [0.5:60]
set xtics (1, 10)
set logscale y
set yrange [10:10000]
set format y "%.0f"
set ylabel "frames/s" offset char 1.5, 0
plot csv using (megapixels(strcol('value'))):(column(speed)) \
  with linespoints ls 1

eval place(0.31, 0.495, 0.09, 0.44)
set title "MP4: digits"
set xlabel "digits of π"
unset logscale x
set xrange [0:22]
set xtics 0, 5
plot csv using (scaled('digits', column('value'))):(column(speed)) with linespoints ls 1

eval place(0.56, 0.745, 0.09, 0.44)
set title "MP4: duration"
set xlabel "seconds of video"
set logscale x
set xrange [5:300]
set xtics (10, 100)
set yrange [0.1:100]
set format y "%g"
set ylabel "seconds of work"
plot csv using (scaled('duration', column('value'))):(column('seconds')) with linespoints ls 1

eval place(0.81, 0.985, 0.09, 0.44)
set title "MP4: memory"
unset logscale y
set yrange [0:200<*]
set ylabel "MB, at most"
plot csv using (scaled('duration', column('value'))):(column('peak_MB')) with linespoints ls 1

unset multiplot
unset output
