# The picture of motion.md: gnuplot -e "rows='motion.csv'; picture='motion.png'" motion.gp
set terminal pngcairo size 1500, 800 font "DejaVu Sans,14" linewidth 1.6
set output picture
set datafile separator ","
set logscale xy
set xrange [1e-5:1e3]
set yrange [0.9:3000]
set format x "10^{%L}"
set xlabel "seconds for a simulated second"
set ylabel "worst figure off by (another regime: 100), %"
set grid xtics ytics lc rgb "#e4e4e4" lt 1 lw 0.8
set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"
set key inside right top Left reverse samplen 1 spacing 1.3
models = "'inertia alone' 'drag coefficient 1' 'preview tables' 'standard tables with default coefficients' 'standard tables with identified coefficients' 'the same with five times the step' 'the same with noise (20 runs)'"
array color[7] = ["#9a9a9a", "#b58b2a", "#6aa84f", "#2a7f8e", "#c0392b", "#e39b90", "#7d3c98"]
# Full CFD is what the others are held against: it has a cost and no error here.
set label "full CFD, by which\nthe others are judged" at 55, 1.8 center tc rgb "#6b6b6b"
plot for [m = 1:7] rows using (strcol(2) eq word(models, m) ? column(3) : NaN):(100 * column(4)) \
       with points lc rgb color[m] pt 7 ps 1.8 title word(models, m), \
     rows using (strcol(2) eq "full CFD" ? column(3) : NaN):(1.0):(0):(0.22) with vectors nohead lc rgb "#1a1a1a" lw 1.2 notitle
