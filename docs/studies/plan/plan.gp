# The picture of plan.md: gnuplot -e "rows='plan.csv'; picture='plan.png'" plan.gp
set terminal pngcairo size 1900, 1050 font "DejaVu Sans,14" linewidth 1.6
set output picture
set datafile separator ","
set logscale xy
set xrange [4:4000]
set yrange [0.05:200]
set grid xtics ytics lc rgb "#e4e4e4" lt 1 lw 0.8
set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"

bodies = "sphere ellipsoid sheet airplane samara leaf"
floored(error) = error > 0.0007 ? 100 * error : 0.07

set multiplot layout 2, 3 margins 0.06, 0.985, 0.13, 0.94 spacing 0.05, 0.1
do for [b = 1:6] {
  set title word(bodies, b)
  set xlabel (b > 3 ? "CPU seconds of the bake" : "")
  set ylabel (b % 3 == 1 ? "worst measure off by, %" : "")
  if (b == 5) { set key at screen 0.5, 0.01 center bottom maxrows 1 Left reverse width -2 samplen 3 } else { set key off }
  plot rows using (strcol(1) eq word(bodies, b) && strcol(2) ne "plan" ? $6 : NaN):(floored(column("worst"))) \
         with linespoints lc rgb "#2a7f8e" pt 7 ps 1.4 title "uniform grid, after symmetry", \
       rows using (strcol(1) eq word(bodies, b) && strcol(2) ne "plan" ? $6 * $4 / $3 : NaN):(floored(column("worst"))) \
         with linespoints lc rgb "#9a9a9a" dt 2 pt 6 ps 1.2 title "uniform grid without symmetry", \
       rows using (strcol(1) eq word(bodies, b) && strcol(2) eq "plan" ? $6 : NaN):(floored(column("worst"))): \
           (floored(column("worst") - 2 * column("worst_chance"))):(floored(column("worst") + 2 * column("worst_chance"))) \
         with yerrorbars lc rgb "#c0392b" pt 5 ps 2 lw 2 title "what the scene needs, with twice its chance"
}
unset multiplot
