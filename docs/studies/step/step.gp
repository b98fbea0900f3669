# The pictures of the step: gnuplot -e "rows='step.csv'; picture='step.png'" step.gp
set terminal pngcairo size 2500, 1120 font "DejaVu Sans,15" linewidth 1.6
set output picture
set datafile separator ","
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set yrange [5e-13:10]
set ytics 1e-12, 100
set grid xtics ytics lc rgb "#e4e4e4" lt 1 lw 0.8
set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"
set key off

bodies = "'rubber ellipsoid' 'paper sheet' 'air bubble' 'neutral ellipsoid' 'copper coin'"
methods = "'explicit Euler' 'Runge-Kutta 4' 'samara reference' 'samara implicit'"
array color[4] = ["#b0b0b0", "#7a7a7a", "#2a7f8e", "#c0392b"]
array mark[4] = [4, 8, 6, 7]

set multiplot layout 2, 5 rowsfirst margins 0.05, 0.992, 0.125, 0.945 spacing 0.034, 0.12
do for [r = 1:2] {
  do for [b = 1:5] {
    body = word(bodies, b)
    if (r == 1) { set title body } else { unset title }
    if (b == 1) { set ylabel "position error / path" } else { unset ylabel }
    if (r == 1) { set xlabel "step, s" } else { set xlabel "CPU ms for a simulated second" }
    if (r == 1) { set xrange [7e-6:0.06] } else { set xrange [5e-3:1500] }
    if (r == 2 && b == 3) { set key at screen 0.5, 0.018 center bottom maxrows 1 Left reverse width 1 samplen 2 } else { set key off }
    set arrow 1 from 1.0/24, graph 0 to 1.0/24, graph 1 nohead lc rgb "#d8b26a" lw 1 dt 2
    if (r == 2) { unset arrow 1 }
    plot for [m = 1:4] rows using (strcol(1) eq body && strcol(2) eq word(methods, m) && strcol(5) ne 'inf' ? column(r == 1 ? 3 : 4) : NaN):5 \
      with linespoints pt mark[m] ps 1.2 lc rgb color[m] title word(methods, m), \
      for [m = 1:4] rows using (r == 1 && strcol(1) eq body && strcol(2) eq word(methods, m) && strcol(5) eq 'inf' ? $3 : NaN):(m == 1 ? 4.0 : 0.8) \
      with points pt 2 ps 1.4 lw 2 lc rgb color[m] notitle
  }
}
unset multiplot
