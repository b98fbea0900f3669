# The picture of the bake, pale what it was before: gnuplot -e "rows='bake.csv'; picture='bake.png'" bake.gp
before = rows[:strlen(rows) - 4]."-before.csv"
set terminal pngcairo size 1900, 720 font "DejaVu Sans,14" linewidth 1.6
set output picture
set datafile separator ","
set logscale xy
set xrange [4:900]
set xlabel "CPU seconds of the bake"
set grid xtics ytics lc rgb "#e4e4e4" lt 1 lw 0.8
set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"
set yrange [0.02:4]
set ytics (".03" 0.03, ".1" 0.1, ".3" 0.3, "1" 1, "3" 3)

bodies = "ellipsoid sheet"
array title_of[3] = ["force", "moment", "k (natural logarithm)"]
array error_column[3] = [7, 9, 11]
array color[2] = ["#c0392b", "#2a7f8e"]
array pale[2] = ["#e9b9b3", "#aacdd3"]

set multiplot layout 1, 3 margins 0.055, 0.99, 0.25, 0.92 spacing 0.045, 0
do for [q = 1:3] {
  set title title_of[q]
  if (q == 1) { set ylabel "error of the table, rms over rms" } else { unset ylabel }
  if (q == 2) { set key at screen 0.5, 0.015 center bottom maxrows 2 Left reverse width 2 samplen 3 } else { set key off }
  plot for [b = 1:2] before using (strcol(1) eq word(bodies, b) ? $3 : NaN):(column(error_column[q])) \
         with linespoints lc rgb pale[b] pt 7 ps 1.2 title word(bodies, b)." before", \
       for [b = 1:2] rows using (strcol(1) eq word(bodies, b) ? $3 : NaN):(column(error_column[q])) \
         with linespoints lc rgb color[b] pt 7 ps 1.4 title word(bodies, b), \
       for [b = 1:2] rows using (strcol(1) eq word(bodies, b) ? $3 : NaN):(column(error_column[q] + 1)) \
         with linespoints lc rgb color[b] dt 2 pt 6 ps 1.2 title word(bodies, b)." as stated", \
       rows using (strcol(1) eq "ellipsoid" ? $3 : NaN):(0.026):(strcol(2)) with labels font ",12" textcolor rgb "#6b6b6b" notitle
}
unset multiplot
