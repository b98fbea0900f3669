# The picture of error against cost beside MuJoCo: gnuplot -e "rows='mujoco.csv'; picture='mujoco.png'" mujoco.gp
set terminal pngcairo size 1500, 700 font "DejaVu Sans,15" linewidth 1.6
set output picture
set datafile separator ","
set logscale xy
set format y "10^{%T}"
set xlabel "CPU ms for one simulated second"
set xrange [0.03:40]
set yrange [1e-10:3]
set grid xtics ytics lc rgb "#e4e4e4" lt 1 lw 0.8
set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"
set key off

methods = "'MuJoCo Euler' 'MuJoCo implicit' 'MuJoCo RK4' 'samara tables' 'samara coefficients'"
array color[5] = ["#b0b0b0", "#7a7a7a", "#2a7f8e", "#c0392b", "#d98c1f"]
titles = "'place after 1 s, error relative to the path' 'orientation after 1 s, error in rad'"

set multiplot layout 1, 2 margins 0.06, 0.99, 0.23, 0.92 spacing 0.07
do for [p = 1:2] {
  set title word(titles, p)
  if (p == 2) { set key at screen 0.5, 0.02 center bottom maxrows 1 Left reverse width -4 samplen 2 }
  plot for [m = 1:5] rows using (strcol(1) eq word(methods, m) ? $3 : NaN):(column(4 + p)) \
    with linespoints pt 7 ps 1.3 lc rgb color[m] title word(methods, m)
}
unset multiplot
