# The picture of error against time: gnuplot -e "rows='kirchhoff.csv'; picture='kirchhoff.png'" kirchhoff.gp
set terminal pngcairo size 2000, 740 font "DejaVu Sans,15" linewidth 1.6
set output picture
set datafile separator ","
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set xlabel "time, ms"
set xrange [0.03:100000]
set yrange [1e-7:100]
set grid xtics ytics lc rgb "#e4e4e4" lt 1 lw 0.8
set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"
set key off

bodies = "'ellipsoid 1:2:4' 'oblate 1:1:0.01' 'cube' 'plate 1:1:0.0001'"
methods = "'offset sources (0.1)' 'offset sources (0.6)' 'samara hypersingular' 'samara from flat mesh' 'samara from curved mesh' 'samara to a tolerance'"
array color[6] = ["#b0b0b0", "#7a7a7a", "#2a7f8e", "#d98c1f", "#c0392b", "#5b3a8e"]

set multiplot layout 1, 4 margins 0.06, 0.985, 0.27, 0.92 spacing 0.04
do for [b = 1:4] {
  body = word(bodies, b)
  set title body
  if (b == 1) { set ylabel "relative tensor error" } else { unset ylabel }
  if (b == 2) { set key at screen 0.5, 0.02 center bottom maxrows 2 Left reverse width 1 samplen 2 } else { set key off }
  plot for [m = 1:6] rows using (strcol(1) eq body && strcol(2) eq word(methods, m) ? $4 : NaN):5 \
    with linespoints pt 7 ps 1.3 lc rgb color[m] title word(methods, m)
}
unset multiplot
